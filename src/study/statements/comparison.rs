//! The two sides of a comparison and its margin.

use super::Reader;
use crate::study::model::{Comparison, Relation, Selection};
use crate::study::spec::statement::{CompareSpec, RelationSpec};
use crate::study::yaml::Node;

impl Reader<'_, '_> {
    pub(super) fn comparison(&mut self, spec: &CompareSpec) -> Comparison {
        let is = match spec.is {
            RelationSpec::Greater => Relation::Greater,
            RelationSpec::Less => Relation::Less,
            RelationSpec::Equal => Relation::Equal,
        };
        Comparison {
            of: spec.of.clone(),
            between: self.sides(),
            is,
            margin: self.margin(spec),
            within_noise: spec.within_noise,
        }
    }

    /// Reads `between`.
    fn sides(&mut self) -> [Selection; 2] {
        let nodes = self.written.fields.get("between").map(Node::elements);
        let nodes = nodes.unwrap_or_default();
        let [first, second] = nodes else {
            let message = format!("`between` takes two selections, {} are given", nodes.len());
            self.fault(
                "between",
                message,
                "write `between: [{axis: value}, {axis: value}]`",
            );
            return Default::default();
        };
        let before = self.problems.len();
        let mut sides: [Selection; 2] = Default::default();
        for (index, node) in [first, second].into_iter().enumerate() {
            let place = format!("between[{index}]");
            if node.entries().is_empty() {
                let field = format!("{}.{place}", self.written.path);
                let message = "this side of the comparison selects nothing in particular";
                let help = "name what tells the two sides apart, as under `where`";
                self.problems.add(&node.span, &field, message, help);
            }
            sides[index] = self.selection_in(node, &place);
        }
        if self.problems.len() > before {
            return sides;
        }
        if sides[0] == sides[1] {
            self.fault("between", "both sides are the same", "let them differ in a value");
            return sides;
        }
        let common = match self.written.fields.get("where") {
            // Its faults are reported where it is read for the statement itself.
            Some(node) => self.quietly(|reader| reader.selection_in(node, "where")),
            None => Selection::default(),
        };
        for (side, node) in sides.iter().zip([first, second]) {
            if !self.selects(&[side, &common]) {
                let field = format!("{}.between", self.written.path);
                let message = "this side of the comparison selects no point of the plan";
                self.problems
                    .add(&node.span, &field, message, "look at its values, and at `where`");
            }
        }
        sides
    }

    /// Reads without reporting.
    pub(super) fn quietly<T>(&mut self, read: impl FnOnce(&mut Reader) -> T) -> T {
        let mut problems = Default::default();
        read(&mut Reader {
            written: self.written,
            context: self.context,
            problems: &mut problems,
        })
    }

    /// `by` or `within`, whichever belongs to the relation; zero where it is left out.
    fn margin(&mut self, spec: &CompareSpec) -> f64 {
        let equal = spec.is == RelationSpec::Equal;
        let (name, margin, other, refused) = match equal {
            true => ("within", spec.within, "by", spec.by),
            false => ("by", spec.by, "within", spec.within),
        };
        if refused.is_some() {
            let message = format!("`{other}` does not go with this relation");
            self.fault(other, message, format!("write `{name}`"));
        }
        if spec.within_noise && !equal {
            let help = "leave it out: a difference that its noise hides decides nothing anyway";
            self.fault("within_noise", "`within_noise` goes with `equal` only", help);
        }
        if equal && margin.is_none() && !spec.within_noise && refused.is_none() {
            let help = "add `within: 1 %`, or `within_noise: true` for the noise of the seeds";
            self.fault("is", "`equal` needs a tolerance", help);
        }
        match margin {
            Some(margin) => {
                self.above_zero(name, margin.0);
                margin.0
            }
            None => 0.0,
        }
    }
}
