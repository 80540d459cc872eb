//! What verdicts contribute to the exit code.

use super::model::{Outcome, Verdict};

/// 1 when an expectation failed, or could not be decided under `strict`; 0 otherwise.
/// Informative expectations never count.
pub fn exit_code(verdicts: &[Verdict], strict: bool) -> u8 {
    let counts = |verdict: &Verdict| match verdict.verdict {
        Outcome::Fails => true,
        Outcome::NotDecidable => strict,
        Outcome::Holds => false,
    };
    let gating = verdicts.iter().filter(|verdict| verdict.informative.is_none());
    u8::from(gating.into_iter().any(counts))
}
