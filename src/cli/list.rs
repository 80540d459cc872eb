//! `kynch list`: everything a study may name, one line each.

use std::fmt::Write;

use kynch_sim::scene::Drag;

use super::console::Paint;
use crate::{reference, study};

const LAWS: [Drag; 5] = [
    Drag::Stokes,
    Drag::Dallavalle,
    Drag::SchillerNaumann,
    Drag::DiFelice,
    Drag::CoulsonRichardson,
];

/// Studies, scenes, drag laws, derived quantities, expectations, references and figures with one line each.
pub fn list(paint: Paint) -> String {
    let mut text = String::new();
    entries(&mut text, paint, "studies", &study::list());
    entries(&mut text, paint, "scenes", &study::scenes());
    section(
        &mut text,
        paint,
        "drag laws",
        LAWS.iter().map(|law| (name(*law), meaning(*law).to_string())),
    );
    entries(&mut text, paint, "derived quantities", &study::derivations());
    entries(&mut text, paint, "expectations", &study::expectations());
    let references = reference::list();
    let lines = references
        .iter()
        .map(|entry| (entry.name, format!("{} [{}]", entry.meaning, entry.source)));
    section(&mut text, paint, "references", lines);
    entries(&mut text, paint, "figures", &study::figures());
    text
}

fn entries(text: &mut String, paint: Paint, title: &str, entries: &[study::Entry]) {
    let lines = entries
        .iter()
        .map(|entry| (entry.name.as_str(), entry.meaning.clone()));
    section(text, paint, title, lines);
}

fn section<'a>(text: &mut String, paint: Paint, title: &str, lines: impl Iterator<Item = (&'a str, String)>) {
    let lines: Vec<_> = lines.collect();
    let width = lines
        .iter()
        .map(|(name, _)| name.chars().count())
        .max()
        .unwrap_or(0);
    let gap = if text.is_empty() { "" } else { "\n" };
    let _ = writeln!(text, "{gap}{}", paint.bold(title));
    for (name, meaning) in &lines {
        let _ = writeln!(text, "  {name:width$}  {meaning}");
    }
    if lines.is_empty() {
        text.push_str("  none found here\n");
    }
}

/// The name of a law in a study file.
fn name(law: Drag) -> &'static str {
    match law {
        Drag::Stokes => "stokes",
        Drag::Dallavalle => "dallavalle",
        Drag::SchillerNaumann => "schiller_naumann",
        Drag::DiFelice => "di_felice",
        Drag::CoulsonRichardson => "coulson_richardson",
    }
}

fn meaning(law: Drag) -> &'static str {
    match law {
        Drag::Stokes => "creeping flow around one sphere, linear in the slip velocity",
        Drag::Dallavalle => "one sphere from creeping flow to turbulence, one closed form",
        Drag::SchillerNaumann => "one sphere up to Reynolds number 800",
        Drag::DiFelice => "Dallavalle's law with a voidage function, for many spheres",
        Drag::CoulsonRichardson => "one sphere from creeping flow to turbulence, a sum of three powers",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_line_up_and_say_when_they_are_empty() {
        let mut text = String::new();
        let paint = Paint { on: false };
        section(
            &mut text,
            paint,
            "laws",
            [("a", "x".to_string()), ("long", "y".to_string())].into_iter(),
        );
        section(&mut text, paint, "none", std::iter::empty());
        assert_eq!(text, "laws\n  a     x\n  long  y\n\nnone\n  none found here\n");
    }

    #[test]
    fn every_law_has_its_own_name() {
        let mut names = LAWS.map(name).to_vec();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), LAWS.len());
    }
}
