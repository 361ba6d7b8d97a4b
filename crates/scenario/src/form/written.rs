//! Keys that select the rows and events to write, and their format.

use super::Count;
use crate::quantity::Time;
use crate::schema::at_least_zero;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::json;
use std::borrow::Cow;
use std::fmt;

/// Events to write: all, none (`off`), or a selection.
#[derive(Debug, Clone)]
pub(crate) enum EventsOutputForm {
    All,
    Off,
    Some(SomeEventsForm),
}

/// Selection of the events that are written.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SomeEventsForm {
    /// Kinds of events that are written; all by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["gross slip", "gross slip ends"]))]
    pub(crate) kinds: Option<Vec<KindForm>>,
    /// Names of contacts; only events of these contacts are written; by default all events.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["ball"]))]
    pub(crate) contacts: Option<Vec<String>>,
    /// Number of events up to which all events are written, at least 100. By default this number is 100 000, or 5 000 000 divided by the
    /// number of contacts if there are more than 50 contacts. After this number, half of the events are written until twice this number
    /// have occurred, then a quarter until four times this number, and so on. Events are left out in blocks of a hundredth of this number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 100), example = 1_000_000)]
    pub(crate) most: Option<Count>,
}

/// Kind of an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum KindForm {
    /// The sliding direction of a contact reverses.
    Reversal,
    /// A hysteresis loop of a contact closes, and its turning point is forgotten.
    #[serde(rename = "loop closed")]
    LoopClosed,
    /// Gross slip begins.
    #[serde(rename = "gross slip")]
    GrossSlip,
    /// Gross slip ends.
    #[serde(rename = "gross slip ends")]
    GrossSlipEnds,
    /// A contact with two friction coefficients breaks loose: gross slip begins.
    #[serde(rename = "breaks loose")]
    BreaksLoose,
    /// A contact that has broken loose sticks again.
    #[serde(rename = "sticks again")]
    SticksAgain,
    /// The contact area begins to grow without slip (full stick).
    #[serde(rename = "full stick")]
    FullStick,
    /// Slip begins in a contact that grew without slip.
    #[serde(rename = "slip begins")]
    SlipBegins,
    /// Two bodies touch.
    Touch,
    /// Two bodies separate.
    #[serde(rename = "lift-off")]
    LiftOff,
    /// A waveform passes a corner between two smooth pieces.
    Corner,
    /// A waveform jumps.
    Jump,
}

/// Time window in which rows and events are written.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("minProperties" = 1))]
pub(crate) struct WindowForm {
    /// Start of the window, s, at least 0; by default the start of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"90 ms", transform = at_least_zero)]
    pub(crate) from: Option<Time>,
    /// End of the window, s, at least 0; by default the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"100 ms", transform = at_least_zero)]
    pub(crate) to: Option<Time>,
}

/// Format of the states of contacts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum StatesForm {
    /// As words: open, stick, partial, slip.
    #[default]
    Words,
    /// As numbers: 0 open, 1 stick, 2 partial, 3 slip.
    Numbers,
}

impl StatesForm {
    #[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes the field by reference")]
    pub(crate) fn is_words(&self) -> bool {
        *self == Self::Words
    }
}

/// Which steps of a drive are written.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum StepsOutputForm {
    /// Every step is written.
    #[default]
    All,
    /// No step is written.
    Off,
}

impl StepsOutputForm {
    #[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes the field by reference")]
    pub(crate) fn is_all(&self) -> bool {
        *self == Self::All
    }
}

impl KindForm {
    /// Returns the name of the event kind, as in `events.csv`.
    pub(crate) fn name(self) -> &'static str {
        use stickslip_drive::EventKind as Kind;
        let kind = match self {
            Self::Reversal => Kind::Reversal,
            Self::LoopClosed => Kind::LoopClosed,
            Self::GrossSlip => Kind::GrossSlip,
            Self::GrossSlipEnds => Kind::GrossSlipEnds,
            Self::BreaksLoose => Kind::BreaksLoose,
            Self::SticksAgain => Kind::SticksAgain,
            Self::FullStick => Kind::FullStick,
            Self::SlipBegins => Kind::SlipBegins,
            Self::Touch => Kind::Touch,
            Self::LiftOff => Kind::LiftOff,
            Self::Corner => Kind::Corner,
            Self::Jump => Kind::Jump,
        };
        kind.name()
    }
}

impl Serialize for EventsOutputForm {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::All => serializer.serialize_str("all"),
            Self::Off => serializer.serialize_str("off"),
            Self::Some(some) => some.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for EventsOutputForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct EventsVisitor;
        impl<'de> Visitor<'de> for EventsVisitor {
            type Value = EventsOutputForm;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("\"all\", \"off\" or an object such as {\"kinds\": [\"gross slip\"]}")
            }

            fn visit_str<E: de::Error>(self, word: &str) -> Result<EventsOutputForm, E> {
                match word {
                    "all" => Ok(EventsOutputForm::All),
                    "off" => Ok(EventsOutputForm::Off),
                    _ => Err(E::invalid_value(de::Unexpected::Str(word), &self)),
                }
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<EventsOutputForm, A::Error> {
                SomeEventsForm::deserialize(MapAccessDeserializer::new(map)).map(EventsOutputForm::Some)
            }
        }
        deserializer.deserialize_any(EventsVisitor)
    }
}

impl JsonSchema for EventsOutputForm {
    fn schema_name() -> Cow<'static, str> {
        "EventsOutputForm".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Which events are written: all, off, or some of them.",
            "anyOf": [{ "enum": ["all", "off"] }, generator.subschema_for::<SomeEventsForm>()]
        })
    }
}
