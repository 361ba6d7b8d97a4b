//! Examples of the repository and random variants of them: engines, integrators, times.

use std::path::{Path, PathBuf};
use stickslip_drive::scene::EngineChoice;
use stickslip_drive::{Plan, State, Stepper};
use stickslip_run::Job;
use stickslip_scenario::Scenario;

pub(crate) fn scenarios() -> Vec<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|e| e == "json")).collect();
    files.sort();
    files
}

/// Marsaglia's xorshift64 generator.
pub(crate) struct Lottery(pub(crate) u64);

impl Lottery {
    pub(crate) fn draw(&mut self, among: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % among as u64) as usize
    }

    pub(crate) fn one<'a>(&mut self, among: &[&'a str]) -> &'a str {
        among[self.draw(among.len())]
    }
}

const PROFILES: [&str; 5] = [
    r#"{"cone":{"slope":0.01}}"#,
    r#"{"sphere":{"radius":"1 mm"}}"#,
    r#"{"power":{"coefficient":1e12,"exponent":4}}"#,
    r#"{"flat":{"radius":"20 um"}}"#,
    r#"{"paraboloid":{"radius":"2 mm"}}"#,
];
const WAVEFORMS: [&str; 4] = [
    r#"{"sine":{"amplitude":"0.3 um","period":"1 ms"}}"#,
    r#"{"triangle":{"stroke":"0.4 um","period":"1 ms"}}"#,
    r#"{"cycloid":{"stroke":"0.4 um","period":"1 ms","flyback":"0.2 ms"}}"#,
    r#"{"sawtooth":{"stroke":"0.4 um","period":"1 ms","flyback":"20 us"}}"#,
];
const STEPPERS: [&str; 6] = [
    r#"{"event":{"tolerance":1e-4}}"#,
    r#"{"event":{"tolerance":1e-6}}"#,
    r#"{"event":{"tolerance":1e-9}}"#,
    r#"{"verlet":{"step":"1 us"}}"#,
    r#"{"rk4":{"step":"1 us"}}"#,
    r#"{"dopri5":{"tolerance":1e-6}}"#,
];
const LINKS: [&str; 3] = [
    r#""stiffness":1e3,"damping":0"#,
    r#""stiffness":0,"damping":0.1"#,
    r#""stiffness":1e4,"damping":1,"preload":"1 mN""#,
];

/// Returns random overrides of one to three properties of a scenario.
pub(crate) fn drawn(base: &Scenario, lottery: &mut Lottery) -> Vec<(String, String)> {
    let scene = &base.scene;
    let mut set = Vec::new();
    for _ in 0..=lottery.draw(3) {
        let contact = scene.contacts.get(lottery.draw(scene.contacts.len().max(1)));
        let Some(contact) = contact.map(|contact| format!("contacts.{}", contact.name)) else { continue };
        let waveform = scene.waveforms.get(lottery.draw(scene.waveforms.len().max(1)));
        let free = scene.bodies.iter().find(|body| body.part.is_free());
        set.push(match lottery.draw(9) {
            0 => (format!("{contact}.profile"), lottery.one(&PROFILES).to_owned()),
            1 => (format!("{contact}.friction"), lottery.one(&["0", "0.05", "0.3", "1"]).to_owned()),
            2 => (format!("{contact}.damping"), lottery.one(&["1e-6", "1e-5"]).to_owned()),
            3 => (format!("{contact}.count"), lottery.one(&["1", "2", "5"]).to_owned()),
            4 => (format!("{contact}.engine"), r#"{"springs":{"count":64}}"#.to_owned()),
            5 => (format!("{contact}.normal"), r#"{"force":"0.4 N"}"#.to_owned()),
            6 => ("run.stepper".to_owned(), lottery.one(&STEPPERS).to_owned()),
            7 => match waveform {
                Some(waveform) => {
                    (format!("waveforms.{}", waveform.name), lottery.one(&WAVEFORMS).to_owned())
                }
                None => continue,
            },
            _ => match free {
                Some(body) => {
                    let link = lottery.one(&LINKS);
                    let ends = format!(r#""between":["ground","{}"],"direction":"x""#, body.name);
                    ("springs".to_owned(), format!(r#"{{"drawn":{{{ends},{link}}}}}"#))
                }
                None => continue,
            },
        });
    }
    set
}

impl Lottery {
    /// Returns random bits.
    pub(crate) fn bits(&mut self) -> u64 {
        self.draw(2);
        self.0
    }

    /// Returns a random number from 0 to 1.
    pub(crate) fn share(&mut self) -> f64 {
        self.draw(1 << 20) as f64 / f64::from(1 << 20)
    }
}

/// Returns the path of an example.
pub(crate) fn example(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name)
}

/// A prepared scenario with the key of its states.
pub(crate) struct Stage {
    pub(crate) job: Job,
    pub(crate) key: [u8; 32],
}

impl Stage {
    /// Prepares a scenario with overrides. Returns `None` if it is invalid.
    pub(crate) fn of(file: &Path, set: &[(String, String)]) -> Option<Self> {
        let job = Job::prepare(file, set, Path::new("")).ok()?;
        let mut key = [0; 32];
        for (i, byte) in key.iter_mut().enumerate() {
            *byte = u8::from_str_radix(&job.hash[2 * i..2 * i + 2], 16).unwrap();
        }
        Some(Self { job, key })
    }

    /// Prepares an example.
    pub(crate) fn example(name: &str) -> Self {
        Self::of(&example(name), &[]).unwrap()
    }

    /// Returns the plan with another integrator and end, s, and sixteen rows.
    pub(crate) fn plan(&self, stepper: Stepper, duration: f64) -> Plan {
        Plan { stepper, duration, every: Some(duration / 16.0), ..self.job.scenario.plan }
    }

    /// Returns the initial state of a plan. Returns `None` if there is none.
    pub(crate) fn start(&self, plan: &Plan) -> Option<State> {
        self.job.model.start(plan).ok()
    }

    /// Returns an integrator with a fixed time step, as a fraction of the longest stable one. Returns `None` if the model has no
    /// oscillation.
    pub(crate) fn step(&self, share: f64, make: fn(f64) -> Stepper) -> Option<Stepper> {
        let longest = self.job.model.longest_step(make(0.0))?;
        longest.is_finite().then(|| make(share * longest))
    }

    /// Returns whether a contact uses a spring row.
    pub(crate) fn has_rows(&self) -> bool {
        let mut contacts = self.job.scenario.scene.contacts.iter();
        contacts.any(|contact| matches!(contact.part.engine, EngineChoice::Springs { .. }))
    }
}

/// Returns the velocity Verlet integrator.
pub(crate) fn verlet(step: f64) -> Stepper {
    Stepper::Verlet { step }
}

/// Returns the classical Runge–Kutta integrator.
pub(crate) fn rk4(step: f64) -> Stepper {
    Stepper::Rk4 { step }
}

/// Returns the frames integrator with a frame length, s, and an accuracy of a thousandth of a stroke.
pub(crate) fn frames(length: f64) -> Stepper {
    Stepper::Frames { length, accuracy: 1e-3 }
}
