//! Sentences broken into lines of similar length, and their symbols as SVG.

use std::fmt::{self, Write};

/// Mean width of a letter, and the height of a line, as fractions of the font size.
const LETTER: f64 = 0.52;
const LINE: f64 = 1.27;
/// Gap between two sentences, as a fraction of the line height.
const GAP: f64 = 0.35;

/// Sentences in lines, below each other.
#[derive(Clone, Debug)]
pub(super) struct Words {
    letters: f64,
    sentences: Vec<Vec<String>>,
}

impl Words {
    /// Sentences at a font size, in lines no longer than a width.
    pub(super) fn wrapped<'a>(
        sentences: impl Iterator<Item = &'a str>,
        letters: f64,
        width: f64,
    ) -> Self {
        let most = (width / (letters * LETTER)) as usize;
        Self {
            letters,
            sentences: sentences.map(|s| balanced(s, most)).collect(),
        }
    }

    /// Width and height (px).
    pub(super) fn size(&self) -> [f64; 2] {
        let lines = self.sentences.iter().flatten();
        let longest = lines.map(|line| length(line)).max().unwrap_or(0);
        let line = self.letters * LINE;
        let count = self.sentences.iter().flatten().count() as f64;
        let gaps = self.sentences.len().saturating_sub(1) as f64 * GAP;
        [
            longest as f64 * self.letters * LETTER,
            (count + gaps) * line,
        ]
    }

    /// The distance of each sentence's first line below the first line of all (px).
    pub(super) fn tops(&self) -> impl Iterator<Item = f64> {
        let line = self.letters * LINE;
        self.sentences.iter().scan(0.0, move |top, sentence| {
            let at = *top;
            *top += (sentence.len() as f64 + GAP) * line;
            Some(at)
        })
    }

    /// Draws the sentences from a position at their top, with an anchor and a colour.
    pub(super) fn draw(
        &self,
        out: &mut String,
        ([x, y], anchor, colour): ([f64; 2], &str, &str),
    ) -> fmt::Result {
        let size = self.letters;
        for (sentence, top) in self.sentences.iter().zip(self.tops()) {
            for (i, line) in sentence.iter().enumerate() {
                let base = y + top + (i as f64 * LINE + 0.97) * size;
                writeln!(
                    out,
                    r#"<text x="{x:.1}" y="{base:.1}" font-size="{size}" text-anchor="{anchor}" fill="{colour}">{}</text>"#,
                    markup(line)
                )?;
            }
        }
        Ok(())
    }
}

/// Breaks a sentence into as few lines of at most `most` letters as possible; the longest line is as short as possible.
fn balanced(sentence: &str, most: usize) -> Vec<String> {
    let count = lines(sentence, most).len();
    let shortest = (1..most).find(|&width| lines(sentence, width).len() <= count);
    lines(sentence, shortest.unwrap_or(most))
}

/// Breaks a sentence into lines of at most `most` letters, or of one word.
fn lines(sentence: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in sentence.split(' ') {
        match lines.last_mut() {
            Some(line) if length(line) + 1 + length(word) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Symbols and their indices.
const SYMBOLS: [(&str, &str, &str); 2] = [("mu_d", "μ", "d"), ("N_i", "N", "i")];

/// The number of letters of a text.
fn length(text: &str) -> usize {
    let spared: usize = SYMBOLS
        .iter()
        .map(|(name, ..)| text.matches(name).count() * (name.len() - 2))
        .sum();
    text.chars().count() - spared
}

/// A text as SVG, with its symbols.
pub(super) fn markup(text: &str) -> String {
    SYMBOLS.iter().fold(text.to_owned(), |text, (name, symbol, index)| {
        let drawn = format!(r#"{symbol}<tspan dy="3" font-size="70%">{index}</tspan><tspan dy="-3">&#8203;</tspan>"#);
        text.replace(name, &drawn)
    })
}
