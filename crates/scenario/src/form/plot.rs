//! Keys of plots: predefined plots by name, and user-defined plots.

use crate::PlotName;
use crate::quantity::Time;
use crate::schema::at_least_zero;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// A plot by its name, or a user-defined plot.
#[derive(Debug, Clone)]
pub(crate) enum PlotForm {
    Named(PlotName),
    Own(OwnPlotForm),
}

/// User-defined plot: one or several channels over another channel.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OwnPlotForm {
    /// Channel on the horizontal axis, a numeric column of `trace.csv`.
    #[schemars(example = &"ball.u_m", example = &"time_s")]
    pub(crate) x: String,
    /// One or several channels on the vertical axis; channels with another unit are drawn on a separate axis below.
    #[schemars(example = &"ball.fx_N")]
    pub(crate) y: ChannelsForm,
    /// Start of the plotted time, s, at least 0; by default the start of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"90 ms", transform = at_least_zero)]
    pub(crate) from: Option<Time>,
    /// End of the plotted time, s, after `from`; by default the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"100 ms", transform = at_least_zero)]
    pub(crate) to: Option<Time>,
}

/// One channel or a list of them.
#[derive(Debug, Clone)]
pub(crate) struct ChannelsForm {
    pub(crate) names: Vec<String>,
    /// Whether the file gives the channels as a list.
    pub(crate) is_list: bool,
}

impl PlotForm {
    /// Returns the name of the plot; all user-defined plots have the same name.
    pub(crate) fn name(&self) -> PlotName {
        match self {
            Self::Named(name) => *name,
            Self::Own(_) => PlotName::Xy,
        }
    }
}

impl Serialize for PlotForm {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Named(name) => name.serialize(serializer),
            Self::Own(own) => own.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for PlotForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PlotVisitor;
        impl<'de> Visitor<'de> for PlotVisitor {
            type Value = PlotForm;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "the name of a picture or an object such as {\"x\": \"ball.u_m\", \"y\": \"ball.fx_N\"}",
                )
            }

            fn visit_str<E: de::Error>(self, word: &str) -> Result<PlotForm, E> {
                PlotName::deserialize(word.into_deserializer()).map(PlotForm::Named)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<PlotForm, A::Error> {
                OwnPlotForm::deserialize(MapAccessDeserializer::new(map)).map(PlotForm::Own)
            }
        }
        deserializer.deserialize_any(PlotVisitor)
    }
}

impl JsonSchema for PlotForm {
    fn schema_name() -> Cow<'static, str> {
        "PlotForm".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A plot by its name, or channels over another channel. These plots are written to `xy-1.png`, `xy-2.png` and so on.",
            "anyOf": [generator.subschema_for::<PlotName>(), generator.subschema_for::<OwnPlotForm>()]
        })
    }
}

impl Serialize for ChannelsForm {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.names[..] {
            [only] if !self.is_list => only.serialize(serializer),
            names => names.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for ChannelsForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ChannelsVisitor;
        impl<'de> Visitor<'de> for ChannelsVisitor {
            type Value = ChannelsForm;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a channel such as \"ball.fx_N\" or a list of them")
            }

            fn visit_str<E: de::Error>(self, name: &str) -> Result<ChannelsForm, E> {
                Ok(ChannelsForm { names: vec![name.to_owned()], is_list: false })
            }

            fn visit_seq<A: SeqAccess<'de>>(self, names: A) -> Result<ChannelsForm, A::Error> {
                let names = Vec::deserialize(SeqAccessDeserializer::new(names))?;
                Ok(ChannelsForm { names, is_list: true })
            }
        }
        deserializer.deserialize_any(ChannelsVisitor)
    }
}

impl JsonSchema for ChannelsForm {
    fn schema_name() -> Cow<'static, str> {
        "ChannelsForm".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "One channel or a list of them.",
            "anyOf": [
                { "type": "string" },
                { "type": "array", "items": { "type": "string" }, "minItems": 1 }
            ]
        })
    }
}
