//! Description of an FMU: `modelDescription.xml` of FMI 2.0 and 3.0.

use super::IDENTIFIER;
use crate::arguments::Fmi;
use quick_xml::escape::escape;
use std::collections::BTreeSet;
use std::fmt::Write;
use stickslip_drive::state_name;
use stickslip_run::Job;
use stickslip_run::interface::{Role, Variable, token, variables};

/// Name of the type of contact states.
const STATE: &str = "contact state";
/// Units with their powers of base units.
const UNITS: [(&str, &str); 19] = [
    ("m", r#"m="1""#),
    ("m/s", r#"m="1" s="-1""#),
    ("m/s²", r#"m="1" s="-2""#),
    ("s", r#"s="1""#),
    ("Hz", r#"s="-1""#),
    ("kg", r#"kg="1""#),
    ("kg m²", r#"kg="1" m="2""#),
    ("N", r#"kg="1" m="1" s="-2""#),
    ("N m", r#"kg="1" m="2" s="-2""#),
    ("N/m", r#"kg="1" s="-2""#),
    ("N s/m", r#"kg="1" s="-1""#),
    ("J", r#"kg="1" m="2" s="-2""#),
    ("Pa", r#"kg="1" m="-1" s="-2""#),
    ("rad", r#"rad="1""#),
    ("rad/s", r#"rad="1" s="-1""#),
    ("V", r#"kg="1" m="2" s="-3" A="-1""#),
    ("A", r#"A="1""#),
    ("F", r#"kg="-1" m="-2" s="4" A="2""#),
    ("m/V", r#"kg="-1" m="-1" s="3" A="1""#),
];

/// Returns the description.
pub(super) fn of(job: &Job, fmi: Fmi) -> String {
    let variables = variables(job);
    let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    // Writing to a text cannot fail.
    let _ = write!(xml, "{}", head(job, fmi));
    let units: BTreeSet<&str> = variables.iter().map(|it| it.unit).filter(|unit| !unit.is_empty()).collect();
    xml.push_str("  <UnitDefinitions>\n");
    for unit in units.into_iter().chain((fmi == Fmi::Three).then_some("s")).collect::<BTreeSet<_>>() {
        let base = UNITS.iter().find(|(name, _)| *name == unit);
        let base = base.map(|(_, powers)| format!("<BaseUnit {powers}/>")).unwrap_or_default();
        let _ = writeln!(xml, "    <Unit name=\"{}\">{base}</Unit>", escape(unit));
    }
    xml.push_str("  </UnitDefinitions>\n");
    let has_states = variables.iter().any(|it| matches!(it.role, Role::Output(_, true)));
    if has_states {
        xml.push_str(&states(fmi));
    }
    xml.push_str("  <LogCategories>\n    <Category name=\"error\"/>\n  </LogCategories>\n");
    let step = job.scenario.plan.every.map(|every| format!(" stepSize=\"{every:e}\"")).unwrap_or_default();
    let stop = job.scenario.plan.duration;
    let _ = writeln!(xml, "  <DefaultExperiment startTime=\"0\" stopTime=\"{stop:e}\"{step}/>");
    xml.push_str("  <ModelVariables>\n");
    if fmi == Fmi::Three {
        xml.push_str("    <Float64 name=\"time\" valueReference=\"0\" causality=\"independent\" variability=\"continuous\" unit=\"s\"/>\n");
    }
    for variable in &variables {
        let _ = writeln!(xml, "    {}", line(variable, fmi));
    }
    xml.push_str("  </ModelVariables>\n  <ModelStructure>\n");
    xml.push_str(&structure(&variables, fmi));
    xml.push_str("  </ModelStructure>\n</fmiModelDescription>\n");
    xml
}

/// Returns the first elements: the model and what co-simulation supports.
fn head(job: &Job, fmi: Fmi) -> String {
    let (version, token_name, state, serialise) = match fmi {
        Fmi::Two => ("2.0", "guid", "canGetAndSetFMUstate", "canSerializeFMUstate"),
        Fmi::Three => ("3.0", "instantiationToken", "canGetAndSetFMUState", "canSerializeFMUState"),
    };
    let memory = if fmi == Fmi::Two {
        " canNotUseMemoryManagementFunctions=\"true\""
    } else {
        " hasEventMode=\"false\""
    };
    format!(
        "<fmiModelDescription fmiVersion=\"{version}\" modelName=\"{}\" {token_name}=\"{}\" generationTool=\"stickslip {}\" variableNamingConvention=\"structured\">\n  \
         <CoSimulation modelIdentifier=\"{IDENTIFIER}\" {state}=\"true\" {serialise}=\"true\" canHandleVariableCommunicationStepSize=\"true\" \
         canBeInstantiatedOnlyOncePerProcess=\"false\"{memory}/>\n",
        escape(job.title()),
        token(&job.resolved),
        env!("CARGO_PKG_VERSION"),
    )
}

/// Returns the type of contact states.
fn states(fmi: Fmi) -> String {
    let items =
        [0.0, 1.0, 2.0, 3.0].map(|code| format!("<Item name=\"{}\" value=\"{code}\"/>", state_name(code)));
    let items = items.join("");
    let kind = match fmi {
        Fmi::Two => format!("<SimpleType name=\"{STATE}\"><Enumeration>{items}</Enumeration></SimpleType>"),
        Fmi::Three => format!("<EnumerationType name=\"{STATE}\">{items}</EnumerationType>"),
    };
    format!("  <TypeDefinitions>\n    {kind}\n  </TypeDefinitions>\n")
}

/// Returns the element of a variable.
fn line(variable: &Variable, fmi: Fmi) -> String {
    let Variable { name, reference, unit, text, role, is_continuous } = variable;
    let (element, attributes) = match role {
        Role::Output(_, true) => ("Enumeration", format!(" declaredType=\"{STATE}\"")),
        Role::Input(_, start, takes) if variable.is_whole() => {
            let (least, most) = takes.bounds();
            let element = if fmi == Fmi::Two { "Integer" } else { "Int32" };
            (element, format!(" start=\"{start}\" min=\"{least}\" max=\"{}\"", most.min(f64::from(i32::MAX))))
        }
        Role::Input(_, start, takes) => {
            let (least, most) = takes.bounds();
            (real(fmi), format!(" start=\"{start:e}\" min=\"{least:e}\" max=\"{most:e}\""))
        }
        Role::Parameter(_, start) => (real(fmi), format!(" start=\"{start:e}\"")),
        Role::Output(_, false) => (real(fmi), String::new()),
    };
    let unit = if unit.is_empty() { String::new() } else { format!(" unit=\"{}\"", escape(*unit)) };
    let (causality, variability, initial) = match role {
        Role::Output(_, true) => ("output", "discrete", " initial=\"calculated\""),
        Role::Output(_, false) => ("output", "continuous", " initial=\"calculated\""),
        Role::Input(..) if *is_continuous => ("input", "continuous", ""),
        Role::Input(..) => ("input", "discrete", ""),
        Role::Parameter(..) => ("parameter", "fixed", " initial=\"exact\""),
    };
    let common = format!(
        "name=\"{}\" valueReference=\"{reference}\" description=\"{}\" causality=\"{causality}\" variability=\"{variability}\"{initial}",
        escape(name.as_str()),
        escape(text.as_str()),
    );
    match fmi {
        Fmi::Two => format!("<ScalarVariable {common}><{element}{unit}{attributes}/></ScalarVariable>"),
        Fmi::Three => format!("<{element} {common}{unit}{attributes}/>"),
    }
}

fn real(fmi: Fmi) -> &'static str {
    if fmi == Fmi::Two { "Real" } else { "Float64" }
}

/// Returns the lists of outputs and of values that are calculated at the start.
fn structure(variables: &[Variable], fmi: Fmi) -> String {
    let outputs = || variables.iter().enumerate().filter(|(_, it)| matches!(it.role, Role::Output(..)));
    match fmi {
        Fmi::Two => {
            let unknowns: String =
                outputs().map(|(i, _)| format!("      <Unknown index=\"{}\"/>\n", i + 1)).collect();
            if unknowns.is_empty() {
                return String::new();
            }
            format!(
                "    <Outputs>\n{unknowns}    </Outputs>\n    <InitialUnknowns>\n{unknowns}    </InitialUnknowns>\n"
            )
        }
        Fmi::Three => {
            let all = |element: &str| -> String {
                let line = |it: &Variable| format!("    <{element} valueReference=\"{}\"/>\n", it.reference);
                outputs().map(|(_, it)| line(it)).collect()
            };
            all("Output") + &all("InitialUnknown")
        }
    }
}
