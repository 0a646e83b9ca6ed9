//! From a word that is no known name to the name that was probably meant.

/// Names more similar to the word than this are offered (Jaro, 0 to 1). The 0.7 of clap offers `burst` for `absent`.
const SIMILAR: f64 = 0.75;

/// The name most similar to a word, regardless of case; none where no name is similar.
pub fn nearest<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    let similarity = |name: &str| strsim::jaro(&word, &name.to_lowercase());
    let rated = names.into_iter().map(|name| (similarity(name), name));
    // Of a short word one slip, such as two letters in the wrong order, is a large part.
    let one_slip = |name: &str| word.len() > 2 && strsim::osa_distance(&word, name) == 1;
    let similar = rated.filter(|(similarity, name)| *similarity > SIMILAR || one_slip(name));
    let best = similar.max_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, name)| name)
}

/// The message about a word that is no known name of a key or an option: the name that was probably meant, and all.
pub fn unknown(what: &str, word: &str, names: &[&str]) -> String {
    let meant = nearest(word, names.iter().copied());
    let meant = meant.map_or(String::new(), |name| format!(", did you mean `{name}`?"));
    format!(
        "unknown {what} `{word}`{meant} (allowed: {})",
        names.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn slips_of_the_keyboard_lead_to_the_name() {
        let names = ["weight", "start", "vertices", "rectangle", "run"];
        for (word, name) in [
            ("wieght", "weight"),
            ("weigth", "weight"),
            ("Weight", "weight"),
            ("vertexes", "vertices"),
            ("rectange", "rectangle"),
            ("strat", "start"),
            ("rnu", "run"),
        ] {
            assert_eq!(nearest(word, names), Some(name), "{word}");
        }
    }

    #[test]
    fn another_word_leads_nowhere() {
        for word in ["", "mass", "colour", "absent"] {
            assert_eq!(nearest(word, ["weight", "burst"]), None, "{word}");
        }
    }
}
