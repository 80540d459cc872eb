//! What a solution reads from the settings of a scene and from what its run has measured.

use serde_json::Value;

use super::drag_law::DragLaw;
use super::grain::Grain;
use super::{Facts, ReferenceError};

/// A scene's settings, opened, and the scalars of its run.
pub struct Case<'a> {
    /// `single_sphere`, `constant_porosity_block`, `rehearsal`.
    pub kind: &'a str,
    body: &'a Value,
    scalars: &'a dyn Fn(&str) -> Option<f64>,
}

impl<'a> Case<'a> {
    pub fn of(facts: &Facts<'a>) -> Result<Self, ReferenceError> {
        let (kind, body) = single(facts.settings)
            .ok_or_else(|| ReferenceError("the run's settings do not name one scene".to_string()))?;
        Ok(Case {
            kind,
            body,
            scalars: facts.scalars,
        })
    }

    /// Refuses a scene the solution `name` does not hold for.
    pub fn only(&self, name: &str, kind: &str) -> Result<(), ReferenceError> {
        if self.kind == kind {
            return Ok(());
        }
        Err(ReferenceError(format!(
            "`{name}` holds for the scene `{kind}`, not for `{}`",
            self.kind
        )))
    }

    /// A scalar that the run has measured; it must be among those that the study keeps.
    pub fn measured(&self, name: &str) -> Result<f64, ReferenceError> {
        (self.scalars)(name).ok_or_else(|| {
            ReferenceError(format!(
                "the run has no scalar `{name}`, which the reference needs: add it to `observe` and run the study again"
            ))
        })
    }

    /// A number at a dotted path.
    pub fn number(&self, path: &str) -> Result<f64, ReferenceError> {
        self.at(path)
            .and_then(Value::as_f64)
            .ok_or_else(|| ReferenceError(format!("the settings of `{}` have no number `{path}`", self.kind)))
    }

    /// A word at a dotted path, or the one key of a map there.
    pub fn word(&self, path: &str) -> Option<&'a str> {
        let value = self.at(path)?;
        value.as_str().or_else(|| single(value).map(|(key, _)| key))
    }

    /// Grain, medium and gravity, whatever the fluid model.
    pub fn grain(&self) -> Result<Grain, ReferenceError> {
        let classes = self.classes()?;
        match classes.as_slice() {
            [(grain, _)] => Ok(*grain),
            _ => Err(ReferenceError(format!(
                "the reference holds for equal grains, the scene has {} classes of them",
                classes.len()
            ))),
        }
    }

    /// Every class of grains with its share of their number; the share is 1 for `grains` alone.
    pub fn classes(&self) -> Result<Vec<(Grain, f64)>, ReferenceError> {
        let count = self.at("classes").and_then(Value::as_array).map(Vec::len);
        let Some(count) = count else {
            return Ok(vec![(self.grain_at("grains")?, 1.0)]);
        };
        let class = |index: usize| {
            let path = format!("classes.{index}");
            Ok((self.grain_at(&path)?, self.number(&format!("{path}.share"))?))
        };
        (0..count).map(class).collect()
    }

    fn grain_at(&self, path: &str) -> Result<Grain, ReferenceError> {
        let model = self.word("fluid").unwrap_or("sph");
        Ok(Grain {
            diameter: self.number(&format!("{path}.diameter"))?,
            density: self.number(&format!("{path}.density"))?,
            fluid_density: self.number(&format!("fluid.{model}.density"))?,
            viscosity: self.number(&format!("fluid.{model}.viscosity"))?,
            gravity: self.number("gravity")?,
        })
    }

    pub fn law(&self) -> Result<DragLaw, ReferenceError> {
        let word = self.word("drag").unwrap_or_default();
        DragLaw::named(word).ok_or_else(|| ReferenceError(format!("no drag law is called `{word}`")))
    }

    /// A number at a dotted path, whatever choice stands on the way: `fluid.density` is found in
    /// `fluid: {still: {density: …}}`.
    pub fn chosen_number(&self, path: &str) -> Option<f64> {
        path.split('.')
            .try_fold(self.body, |value, key| {
                let chosen = || single(value).and_then(|(_, body)| body.get(key));
                value.get(key).or_else(chosen)
            })?
            .as_f64()
    }

    fn at(&self, path: &str) -> Option<&'a Value> {
        path.split('.').try_fold(self.body, |value, key| {
            let place = || value.get(key.parse::<usize>().ok()?);
            value.get(key).or_else(place)
        })
    }
}

fn single(value: &Value) -> Option<(&str, &Value)> {
    let mut fields = value.as_object()?.iter();
    match (fields.next(), fields.next()) {
        (Some((key, body)), None) => Some((key, body)),
        _ => None,
    }
}
