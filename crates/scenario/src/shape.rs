//! Lists where objects belong: serde takes the values of an object from a list in their order, and nobody who wrote a
//! list meant that.

use crate::fault::Fault;
use crate::guide::{Guide, Help};
use crate::path::{KeyPath, Step};
use serde_json::Value;

/// Refuses lists that the schema does not know.
pub(crate) fn check(value: &Value) -> Result<(), Fault> {
    let guide = Guide::get();
    walk(guide, guide.root(), value, &mut KeyPath::default())
}

fn walk(guide: &Guide, schema: &Value, value: &Value, path: &mut KeyPath) -> Result<(), Fault> {
    let mut inside = |step: Step, inner: &Value| {
        // Whatever has no place in the schema is refused elsewhere.
        let Some(schema) = guide.enter(schema, &step) else { return Ok(()) };
        path.0.push(step);
        walk(guide, schema, inner, path)?;
        path.0.pop();
        Ok(())
    };
    match value {
        Value::Object(entries) => {
            entries.iter().try_for_each(|(key, inner)| inside(Step::Key(key.clone()), inner))
        }
        Value::Array(entries) if guide.has_lists(schema) => {
            entries.iter().enumerate().try_for_each(|(i, inner)| inside(Step::Index(i), inner))
        }
        Value::Array(_) => {
            let fault = Fault::new(path.clone(), "expected an object").with_value();
            Err(fault.ask(Help::Shape))
        }
        _ => Ok(()),
    }
}
