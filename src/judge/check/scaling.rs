//! A scalar grows along an axis like a power of it.

use super::{Finding, Part, blank};
use crate::judge::convergence::observed_order;
use crate::judge::model::PointVerdict;
use crate::judge::point_error::mean_scalar;
use crate::judge::select::Chain;
use crate::judge::words::significant;

pub fn check(chains: &[Chain], of: &str, over: &str, is: f64, within: f64) -> Finding {
    let mut finding = Finding {
        unit: "1".to_string(),
        expected: Some(is),
        source: "stated in the study".to_string(),
        ..Finding::default()
    };
    if chains.is_empty() {
        let reason = format!("no selected run has a number `{over}` to grow along");
        finding.parts.push(Part::open(reason));
    }
    let mut worst = 0.0;
    for chain in chains {
        let part = match exponent(&mut finding, chain, of, over) {
            Err(why) => Part::open(format!("{}: {why}", chain.label)),
            Ok(exponent) => {
                let off = (exponent - is).abs();
                if finding.computed.is_none() || off > worst {
                    worst = off;
                    finding.computed = Some(exponent);
                }
                match off <= within {
                    true => Part::holds(),
                    false => Part::fails(format!("{}: exponent {}", chain.label, significant(exponent, 4))),
                }
            }
        };
        finding.parts.push(part);
    }
    finding
}

/// Least-squares slope of ln of over ln over.
fn exponent(finding: &mut Finding, chain: &Chain, of: &str, over: &str) -> Result<f64, String> {
    let (mut places, mut values) = (Vec::new(), Vec::new());
    for (place, group) in &chain.steps {
        let mean = mean_scalar(group, of).map_err(|undecided| undecided.to_string())?;
        finding.points.push(PointVerdict {
            computed: Some(mean.value),
            ..blank(group)
        });
        places.push(*place);
        values.push(mean.value);
    }
    if places.len() < 2 {
        return Err(format!("one value of {over}, an exponent needs two"));
    }
    let slope = observed_order(&places, &values).order;
    match slope.is_finite() {
        true => Ok(slope),
        false => Err(format!(
            "`{of}` or `{over}` is zero somewhere: there is no exponent"
        )),
    }
}
