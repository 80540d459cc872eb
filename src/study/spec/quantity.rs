//! Fields that take a number or a number with a unit, and fields that take one or more.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;

use crate::study::units::{self, Dimension, Measured};

/// Schema keyword: the dimension of a quantity by name, `any` for all.
pub const DIMENSION: &str = "x-dimension";
/// Schema keyword: words that may stand in place of the quantity.
pub const WORDS: &str = "x-words";
/// Schema keyword: one element or a list of them.
pub const ONE_OR_MORE: &str = "x-one-or-more";
/// Schema keyword: a value of any kind, checked elsewhere.
pub const ANYTHING: &str = "x-anything";

fn read<'de, D: Deserializer<'de>>(input: D, dimension: Dimension) -> Result<f64, D::Error> {
    match Value::deserialize(input)? {
        Value::Number(number) => number.as_f64().ok_or_else(|| D::Error::custom("not a number")),
        Value::String(text) => units::parse_as(&text, dimension).map_err(D::Error::custom),
        _ => Err(D::Error::custom("not a quantity")),
    }
}

fn described(dimension: &str, unit: &str, words: &[&str]) -> Schema {
    json_schema!({
        "type": ["number", "string"],
        "description": format!("A number in {unit}, or text with a unit."),
        "x-dimension": dimension,
        "x-words": words,
    })
}

macro_rules! quantity {
    ($(#[$doc:meta])* $name:ident, $dimension:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name(pub f64);

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
                read(input, $dimension).map($name)
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, output: S) -> Result<S::Ok, S::Error> {
                output.serialize_f64(self.0)
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                described($dimension.name().unwrap_or_default(), &$dimension.unit(), &[])
            }
        }
    };
}

quantity!(
    /// [m]
    Length,
    Dimension::LENGTH
);
quantity!(
    /// [s]
    Time,
    Dimension::TIME
);
quantity!(
    /// [kg/m³]
    Density,
    Dimension::DENSITY
);
quantity!(
    /// [Pa s]
    Viscosity,
    Dimension::VISCOSITY
);
quantity!(
    /// [m/s²]
    Acceleration,
    Dimension::ACCELERATION
);
quantity!(
    /// [m/s]
    Speed,
    Dimension::SPEED
);
quantity!(
    /// [rad/s]
    AngularVelocity,
    Dimension::FREQUENCY
);
quantity!(
    /// [1/s]
    Frequency,
    Dimension::FREQUENCY
);
quantity!(
    /// [1/m]
    MediumResistance,
    Dimension::RESISTANCE
);
quantity!(
    /// [Pa]
    Pressure,
    Dimension::PRESSURE
);
quantity!(
    /// [N/m]
    Stiffness,
    Dimension::STIFFNESS
);
quantity!(
    /// [N s/m]
    Damping,
    Dimension::DAMPING
);
quantity!(
    /// [J]
    Energy,
    Dimension::ENERGY
);
quantity!(
    /// [C]
    Charge,
    Dimension::CHARGE
);
quantity!(
    /// Dimensionless; `1 %` is 0.01.
    Fraction,
    Dimension::NONE
);

/// A quantity, or a word for "the program chooses" or "left out".
macro_rules! quantity_or_word {
    ($name:ident, $dimension:expr, $($variant:ident = $word:literal),+) => {
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum $name {
            $($variant,)+
            Value(f64),
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
                let value = Value::deserialize(input)?;
                match value.as_str() {
                    $(Some($word) => return Ok($name::$variant),)+
                    _ => {}
                }
                read(value, $dimension).map($name::Value).map_err(D::Error::custom)
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, output: S) -> Result<S::Ok, S::Error> {
                match self {
                    $($name::$variant => output.serialize_str($word),)+
                    $name::Value(value) => output.serialize_f64(*value),
                }
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                described($dimension.name().unwrap_or_default(), &$dimension.unit(), &[$($word),+])
            }
        }
    };
}

quantity_or_word!(
    SoundSpeedSpec,
    Dimension::SPEED,
    Automatic = "automatic",
    FreeFall = "free_fall"
);
quantity_or_word!(TimeStepSpec, Dimension::TIME, Automatic = "automatic");
quantity_or_word!(StiffnessSpec, Dimension::STIFFNESS, Automatic = "automatic");
quantity_or_word!(SkinSpec, Dimension::NONE, Automatic = "automatic");
quantity_or_word!(CoefficientSpec, Dimension::NONE, None = "none");

/// A quantity of any dimension, compared with an observable's own later.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnyQuantity {
    pub value: f64,
    /// `None` for a bare number: SI is meant.
    pub dimension: Option<Dimension>,
}

impl<'de> Deserialize<'de> for AnyQuantity {
    fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
        match Value::deserialize(input)? {
            Value::Number(number) => Ok(AnyQuantity {
                value: number.as_f64().unwrap_or(f64::NAN),
                dimension: None,
            }),
            Value::String(text) => {
                let Measured { value, dimension } = units::parse(&text).map_err(D::Error::custom)?;
                Ok(AnyQuantity {
                    value,
                    dimension: Some(dimension),
                })
            }
            _ => Err(D::Error::custom("not a quantity")),
        }
    }
}

impl JsonSchema for AnyQuantity {
    fn schema_name() -> Cow<'static, str> {
        "AnyQuantity".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        described("any", "SI units", &[])
    }
}

/// One element, or a list of them.
#[derive(Clone, Debug, PartialEq)]
pub struct OneOrMore<T>(pub Vec<T>);

impl<'de, T: DeserializeOwned> Deserialize<'de> for OneOrMore<T> {
    fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
        let elements = match Value::deserialize(input)? {
            Value::Array(elements) => elements,
            single => vec![single],
        };
        let elements: Result<Vec<T>, _> = elements.into_iter().map(T::deserialize).collect();
        elements.map(OneOrMore).map_err(D::Error::custom)
    }
}

impl<T: JsonSchema> JsonSchema for OneOrMore<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("OneOrMore{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let element = generator.subschema_for::<T>();
        json_schema!({
            "anyOf": [element, {"type": "array", "items": element, "minItems": 1}],
            "x-one-or-more": element,
        })
    }
}

/// A number, a flag, a word or a quantity.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct Scalar(pub Value);

impl JsonSchema for Scalar {
    fn schema_name() -> Cow<'static, str> {
        "Scalar".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({"type": ["number", "string", "boolean"]})
    }
}

/// Whatever the field that an axis varies takes.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct Anything(pub Value);

impl JsonSchema for Anything {
    fn schema_name() -> Cow<'static, str> {
        "Anything".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({"x-anything": true, "description": "Whatever the varied field takes."})
    }
}
