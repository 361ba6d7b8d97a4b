//! Names of materials and profiles of contacts, and key paths of parts, which the model does not contain.

use crate::Scenario;
use crate::form::ProfileForm;

impl Scenario {
    /// Returns the names of the two materials of contact `index`.
    pub fn materials_of(&self, index: usize) -> Option<[&str; 2]> {
        let (_, contact) = self.form.contacts.0.get(index)?;
        Some(contact.materials.0.each_ref().map(String::as_str))
    }

    /// Returns the key of the profile of contact `index`, such as `paraboloid`.
    pub fn profile_of(&self, index: usize) -> Option<&'static str> {
        let (_, contact) = self.form.contacts.0.get(index)?;
        Some(contact.profile.word())
    }

    /// Returns the radius of curvature R of a ball, m, and whether its profile is a paraboloid. Returns `None` for other profiles.
    pub fn ball_of(&self, index: usize) -> Option<(f64, bool)> {
        match &self.form.contacts.0.get(index)?.1.profile {
            ProfileForm::Paraboloid(ball) => Some((ball.radius.si, true)),
            ProfileForm::Sphere(ball) => Some((ball.radius.si, false)),
            _ => None,
        }
    }

    /// Returns materials with their Young's moduli, Pa, in the order of the file.
    pub fn materials(&self) -> impl Iterator<Item = (&str, f64)> {
        self.form.materials.iter().map(|(name, material)| (name, material.youngs_modulus.si))
    }

    /// Returns Young's modulus, Pa, and Poisson's ratio of a material.
    pub fn elasticity(&self, material: &str) -> Option<(f64, f64)> {
        let (_, material) = self.form.materials.0.get(self.form.materials.find(material)?)?;
        Some((material.youngs_modulus.si, material.poisson_ratio))
    }

    /// Returns the key path of the stiffness or capacitance of an actuator: its own key if given, otherwise the key of its data sheet.
    pub fn stack_path(&self, actuator: &str, key: &str) -> String {
        let actuators = &self.form.actuators;
        let form = actuators.find(actuator).and_then(|place| actuators.0.get(place)).map(|(_, form)| form);
        let is_own = form.is_some_and(|form| match key {
            "stiffness" => form.stiffness.is_some(),
            _ => form.capacitance.is_some(),
        });
        let sheet = if is_own { "" } else { ".data_sheet" };
        format!("actuators.{actuator}{sheet}.{key}")
    }

    /// Returns the key path of waveform `index`: named waveforms are in `waveforms`, others at the key that follows them.
    pub fn waveform_path(&self, index: usize) -> Option<String> {
        let name = &self.scene.waveforms.get(index)?.name;
        Some(if self.form.waveforms.find(name).is_some() {
            format!("waveforms.{name}")
        } else {
            name.clone()
        })
    }

    /// Returns materials that no contact uses, in the order of the file.
    pub fn unused_materials(&self) -> impl Iterator<Item = &str> {
        let is_used =
            |name: &str| self.form.contacts.iter().any(|(_, c)| c.materials.0.iter().any(|m| m == name));
        self.form.materials.names().filter(move |name| !is_used(name))
    }
}

#[cfg(test)]
mod tests {
    use crate::Scenario;

    #[test]
    fn contacts_know_their_materials_and_profiles() {
        let text = include_str!("../../../scenarios/quickstart.json");
        let scenario = Scenario::from_str(
            &text.replace("[\"ruby\", \"hardened steel\"]", "[\"hardened steel\", \"hardened steel\"]"),
            "a",
            "",
        );
        let scenario = scenario.unwrap();
        assert_eq!(scenario.materials_of(0), Some(["hardened steel", "hardened steel"]));
        assert_eq!(scenario.profile_of(0), Some("paraboloid"));
        assert_eq!(scenario.unused_materials().collect::<Vec<_>>(), ["ruby"]);
        assert_eq!((scenario.materials_of(1), scenario.profile_of(1)), (None, None));
    }
}
