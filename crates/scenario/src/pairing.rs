//! What contacts are made of and where numbers stand, in the file's own words: a scene has moduli and a profile, but no names of them.

use crate::Scenario;
use crate::form::ProfileForm;

impl Scenario {
    /// Names of the materials of contact `index`, first and second.
    pub fn materials_of(&self, index: usize) -> Option<[&str; 2]> {
        let (_, contact) = self.form.contacts.0.get(index)?;
        Some(contact.materials.0.each_ref().map(String::as_str))
    }

    /// The word for the profile of contact `index`, such as `paraboloid`.
    pub fn profile_of(&self, index: usize) -> Option<&'static str> {
        let (_, contact) = self.form.contacts.0.get(index)?;
        Some(contact.profile.word())
    }

    /// Radius of curvature R of the ball of contact `index`, m, and whether it is a paraboloid in its place; none of other
    /// profiles.
    pub fn ball_of(&self, index: usize) -> Option<(f64, bool)> {
        match &self.form.contacts.0.get(index)?.1.profile {
            ProfileForm::Paraboloid(ball) => Some((ball.radius.si, true)),
            ProfileForm::Sphere(ball) => Some((ball.radius.si, false)),
            _ => None,
        }
    }

    /// Materials and their Young's moduli, Pa, in the order of the file.
    pub fn materials(&self) -> impl Iterator<Item = (&str, f64)> {
        self.form.materials.iter().map(|(name, material)| (name, material.youngs_modulus.si))
    }

    /// Young's modulus, Pa, and Poisson's ratio of a material.
    pub fn elasticity(&self, material: &str) -> Option<(f64, f64)> {
        let (_, material) = self.form.materials.0.get(self.form.materials.find(material)?)?;
        Some((material.youngs_modulus.si, material.poisson_ratio))
    }

    /// The key path of the stiffness or the capacitance of an actuator: its own, or else that of its data sheet.
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

    /// The key path of waveform `index`: it has a name, or stands where it is used and is named by its path.
    pub fn waveform_path(&self, index: usize) -> Option<String> {
        let name = &self.scene.waveforms.get(index)?.name;
        Some(if self.form.waveforms.find(name).is_some() {
            format!("waveforms.{name}")
        } else {
            name.clone()
        })
    }

    /// Materials of which no contact is made, in the order of the file.
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
