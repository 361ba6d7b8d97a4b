//! Runs that own their jobs, and tables in memory.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use stickslip_drive::Stepper;
use stickslip_run::{Held, Job, Table};
use stickslip_scenario::Scenario;

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(format!("{name}.json"))
}

fn job(name: &str) -> Arc<Job> {
    Arc::new(Job::prepare(&example(name), &[], Path::new("")).unwrap())
}

/// Returns all rows and events of a job.
fn table(job: &Job) -> Table {
    let mut table = Table::new(&job.model);
    stickslip_drive::run(&job.model, &job.scenario.plan, &mut job.start.clone(), &mut table).unwrap();
    table
}

#[test]
fn the_row_before_the_first_advance_is_the_first_that_is_written() {
    for entry in std::fs::read_dir(example("p1").parent().unwrap()).unwrap() {
        let file = entry.unwrap().path();
        if file.extension().is_none_or(|end| end != "json") {
            continue;
        }
        let job = Arc::new(Job::prepare(&file, &[], Path::new("")).unwrap());
        if matches!(job.scenario.plan.stepper, Stepper::Dopri5 { .. }) {
            continue;
        }
        let first = table(&job);
        let row = Held::new(job).unwrap().row();
        assert_eq!(row.len(), first.channels().len(), "{}", file.display());
        for (place, channel) in first.channels().iter().enumerate() {
            let value = first.column(&channel.name).unwrap()[0];
            assert_eq!(row[place].to_bits(), value.to_bits(), "{}: {}", file.display(), channel.name);
        }
    }
}

#[test]
fn a_held_run_goes_from_thread_to_thread_and_on_from_its_bytes() {
    let job = job("quickstart");
    let mut run = Held::new(Arc::clone(&job)).unwrap();
    run.advance(0.01, &mut ()).unwrap();
    let bytes = run.to_bytes();
    let row = std::thread::spawn(move || {
        run.advance(0.02, &mut ()).unwrap();
        run.row()
    });
    let mut again = Held::from_bytes(Arc::clone(&job), &bytes).unwrap();
    assert_eq!(again.time(), 0.01);
    again.advance(0.02, &mut ()).unwrap();
    assert_eq!(again.row(), row.join().unwrap());
    assert!(Held::from_bytes(job, &bytes[1..]).is_err());
}

#[test]
fn channels_and_ports_say_what_they_are() {
    let run = Held::new(job("commanded")).unwrap();
    let channels = run.channels();
    assert_eq!(channels.len(), run.row().len());
    let lacking: Vec<_> = channels.iter().filter(|channel| channel.text.is_empty()).collect();
    assert!(lacking.is_empty(), "{lacking:?}");
    let x = channels.iter().find(|channel| channel.name == "slider.x_m").unwrap();
    assert_eq!(x.unit, "m");
    let [stroke, frequency, heading, steps] = &run.inputs()[..] else { panic!("{:?}", run.inputs()) };
    assert_eq!([stroke, frequency, heading, steps].map(|input| input.unit), ["m", "Hz", "", ""]);
    assert!(stroke.takes.has(stroke.initial) && heading.takes.has(-1.0) && !heading.takes.has(0.0));
}

#[test]
fn a_table_has_all_rows_and_events_by_channel() {
    let job = job("p1");
    let table = table(&job);
    assert_eq!((table.rows(), table.events().len()), (10_001, 165));
    assert_eq!(table.column("time_s").unwrap()[10_000], 0.02);
    assert_eq!(table.states("ball.state").unwrap().count(), 10_001);
    assert!(table.states("slider.x_m").is_none() && table.column("slider.y_m").is_none());
}

#[test]
fn a_text_alone_is_told_in_the_caller_s_words() {
    let text = std::fs::read_to_string(example("p1")).unwrap();
    let set = [("run.cycles", "2")];
    assert!(Scenario::read(&text, ("", "set="), None, &set).is_ok());
    let said = |text: &str, set: &[(&str, &str)]| {
        Scenario::read(text, ("", "with"), None, set).unwrap_err().to_string()
    };
    assert!(
        said(&text, &[("run.cycle", "2")]).starts_with("with run.cycle=2  "),
        "{}",
        said(&text, &[("run.cycle", "2")])
    );
    let wrong = said(&text.replace("\"20 g\"", "\"-20 g\""), &[]);
    assert!(wrong.starts_with("line ") && !wrong.contains("--set"), "{wrong}");
}
