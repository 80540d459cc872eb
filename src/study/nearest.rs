//! The nearest right name to a misspelt one.

/// The candidate fewest slips away, where so few are plausible: a third of the letters, at least one.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = (word.chars().count() / 3).clamp(1, 4);
    candidates
        .into_iter()
        .map(|candidate| (distance(&word.to_lowercase(), candidate), candidate))
        .filter(|(slips, _)| *slips <= limit)
        .min_by_key(|(slips, _)| *slips)
        .map(|(_, candidate)| candidate)
}

/// Names an advice lists at most.
const LISTED: usize = 12;

/// `did you mean …?` where a name is near, else the names there are, or the first of many.
pub fn advice(word: &str, candidates: &[&str]) -> String {
    match nearest(word, candidates.iter().copied()) {
        Some(name) => format!("did you mean `{name}`?"),
        None if candidates.is_empty() => "there is none to choose from".to_owned(),
        None if candidates.len() <= LISTED => format!("known: {}", candidates.join(", ")),
        None => {
            let first = candidates[..LISTED].join(", ");
            format!(
                "known: {first} and {} more; `kynch explain` lists them",
                candidates.len() - LISTED
            )
        }
    }
}

/// Damerau–Levenshtein distance, optimal string alignment: insertions, deletions, substitutions
/// and swaps of neighbours.
fn distance(left: &str, right: &str) -> usize {
    let left: Vec<char> = left.chars().take(80).collect();
    let right: Vec<char> = right.chars().take(80).collect();
    let mut rows: Vec<Vec<usize>> = vec![(0..=right.len()).collect()];
    for i in 1..=left.len() {
        let mut row = vec![i];
        for j in 1..=right.len() {
            let change = usize::from(left[i - 1] != right[j - 1]);
            let mut best = (row[j - 1] + 1)
                .min(rows[i - 1][j] + 1)
                .min(rows[i - 1][j - 1] + change);
            if i > 1 && j > 1 && left[i - 1] == right[j - 2] && left[i - 2] == right[j - 1] {
                best = best.min(rows[i - 2][j - 2] + 1);
            }
            row.push(best);
        }
        rows.push(row);
    }
    rows[left.len()][right.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_finds_its_name_and_nonsense_finds_none() {
        let names = ["stokes", "dallavalle", "di_felice"];
        for (word, expected) in [
            ("stoke", Some("stokes")),
            ("sotkes", Some("stokes")),
            ("di-felice", Some("di_felice")),
            ("Stokes", Some("stokes")),
            ("newton", None),
        ] {
            assert_eq!(nearest(word, names), expected, "{word}");
        }
    }
}
