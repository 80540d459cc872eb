//! The shape of a study file, as types: they are what `kynch schema` prints and what the
//! structural check of a file follows.

pub mod collision;
pub mod derived;
pub mod filtration;
pub mod quantity;
pub mod scene;
pub mod sedimentation;
pub mod statement;

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

use derived::DerivedSpec;
use quantity::{Anything, OneOrMore, Scalar, Time};
use scene::SceneSpec;
use statement::{CalibratedSpec, ExpectationSpec, FigureSpec};

/// A study: a question, the scenes it is asked of, what varies, what is observed and expected.
#[derive(Debug, Deserialize, JsonSchema)]
#[expect(
    dead_code,
    reason = "gives the schema; values are read from the tree, with their positions"
)]
pub struct StudySpec {
    /// The question the study answers, one sentence.
    pub question: String,
    /// The one scene; a study with several names them under `scenes`.
    pub scene: Option<SceneSpec>,
    /// Several scenes by name.
    pub scenes: Option<BTreeMap<String, SceneSpec>>,
    /// Axes by name; the plan is their product.
    #[serde(default)]
    pub vary: BTreeMap<String, AxisSpec>,
    /// A number N for the seeds 1 to N, or a list of seeds.
    #[serde(default = "one_seed")]
    pub seeds: OneOrMore<u64>,
    /// Inputs that were fitted to some of the points; the others are predictions.
    #[serde(default)]
    pub calibrated: Vec<CalibratedSpec>,
    /// Numbers made of the series of each run, by name: scalars everywhere after.
    #[serde(default)]
    pub derive: BTreeMap<String, DerivedSpec>,
    /// Observables to keep.
    #[serde(default)]
    pub observe: Vec<String>,
    /// What is expected to hold.
    #[serde(default)]
    pub expect: Vec<ExpectationSpec>,
    /// Figures to draw.
    #[serde(default)]
    pub figures: Vec<FigureSpec>,
    /// What a point took elsewhere: shown beside the processor time of ours.
    pub published_time: Option<PublishedTimeSpec>,
    /// Points to leave out: every name given must match.
    #[serde(default)]
    pub exclude: Vec<Where>,
}

/// What one point took elsewhere.
#[derive(Debug, Deserialize, JsonSchema)]
#[expect(
    dead_code,
    reason = "gives the schema; values are read from the tree, with their positions"
)]
pub struct PublishedTimeSpec {
    /// Time of one point.
    pub is: Time,
    /// Where it is printed, and what machine it was.
    pub source: String,
}

/// Values admitted by name: `scene`, an axis, or a settings field.
pub type Where = BTreeMap<String, OneOrMore<Scalar>>;

fn one_seed() -> OneOrMore<u64> {
    OneOrMore(vec![1])
}

/// A varied parameter.
#[derive(Debug, Deserialize, JsonSchema)]
#[expect(
    dead_code,
    reason = "gives the schema; values are read from the tree, with their positions"
)]
pub struct AxisSpec {
    /// Where it acts: `scene.column.width` in every scene that has it, `scenes.NAME.column.width` in one.
    pub path: OneOrMore<String>,
    /// The axis it moves along with, value by value.
    pub with: Option<String>,
    pub values: Vec<Anything>,
}

/// The JSON Schema of a study file.
pub fn schema() -> serde_json::Value {
    let mut schema = serde_json::Value::from(schemars::schema_for!(StudySpec));
    close(&mut schema);
    if let Some(root) = schema.as_object_mut() {
        root.insert("title".into(), "kynch study".into());
    }
    schema
}

/// Forbids keys that are not named, everywhere.
fn close(schema: &mut serde_json::Value) {
    match schema {
        serde_json::Value::Object(fields) => {
            if fields.contains_key("properties") && !fields.contains_key("additionalProperties") {
                fields.insert("additionalProperties".into(), false.into());
            }
            fields.values_mut().for_each(close);
        }
        serde_json::Value::Array(elements) => elements.iter_mut().for_each(close),
        _ => {}
    }
}
