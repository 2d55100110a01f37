//! Scene files: good ones with other numbers, keys and tables, and any text. Each runs, or ends with one line; what is
//! written is finite.

use std::fs;
use std::path::Path;

use femto_cli::rehearsal::rehearse;
use tempfile::TempDir;

use super::bytes::Bytes;

/// Between them they have every key.
const GOOD: [&str; 3] = [
    include_str!("parts.toml"),
    include_str!("coupled.toml"),
    include_str!("factor.toml"),
];

const VALUES: [&str; 32] = [
    "0",
    "1",
    "-1",
    "2",
    "0.5",
    "1e3",
    "1e-3",
    "1e10",
    "1e20",
    "1e38",
    "3e38",
    "1e39",
    "1e308",
    "-0.0",
    "1e-20",
    "1e-38",
    "1e-44",
    "1e-46",
    "nan",
    "inf",
    "-inf",
    "255",
    "4294967295",
    "9223372036854775807",
    "[0, 0, 0]",
    "[1, 2]",
    "[]",
    "{}",
    "\"x\"",
    "\"\"",
    "true",
    "1979-05-27",
];

/// The first byte chooses: the rest is text, or edits of a good scene.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let choice = usize::from(bytes.byte());
    let Some(good) = GOOD.get(choice % 4) else {
        let text = String::from_utf8_lossy(data.get(1..).unwrap_or_default());
        check(&text, None);
        return;
    };
    let mut lines: Vec<String> = good.lines().map(str::to_owned).collect();
    let edits = bytes.below(6);
    for _ in 0..edits {
        edit(&mut lines, &mut bytes);
    }
    let text = lines.join("\n");
    // Files take longer than a run.
    let folder = (bytes.below(8) == 7).then(|| tempfile::tempdir().expect("a temporary folder"));
    let status = check(&text, folder.as_ref().map(TempDir::path));
    assert!(edits > 0 || status == 0, "a good scene must run");
}

/// A number becomes another, a line comes twice or goes, a table ends early, a letter changes.
fn edit(lines: &mut Vec<String>, bytes: &mut Bytes<'_>) {
    let at = usize::from(bytes.byte()) % lines.len().max(1);
    let Some(line) = lines.get_mut(at) else {
        return;
    };
    let place = usize::from(bytes.byte());
    match bytes.below(8) {
        0 => _ = lines.remove(at),
        1 => {
            let again = line.clone();
            lines.insert(place % (lines.len() + 1), again);
        }
        2 => {
            let mut letters: Vec<char> = line.chars().collect();
            let count = letters.len().max(1);
            if let Some(letter) = letters.get_mut(place % count) {
                *letter = char::from(bytes.byte());
            }
            *line = letters.into_iter().collect();
        }
        _ => {
            let values = values(line);
            if let Some(range) = values.get(place % values.len().max(1)) {
                line.replace_range(range.clone(), VALUES[bytes.below(VALUES.len())]);
            }
        }
    }
}

/// Where a line has numbers and words in quotes.
fn values(line: &str) -> Vec<std::ops::Range<usize>> {
    let mut found = Vec::new();
    let start = line.find('=').map_or(line.len(), |at| at + 1);
    let mut from = None;
    for (at, letter) in line.char_indices().skip_while(|(at, _)| *at < start) {
        let part = letter.is_ascii_alphanumeric() || "+-._\"".contains(letter);
        match (part, from) {
            (true, None) => from = Some(at),
            (false, Some(begin)) => {
                found.push(begin..at);
                from = None;
            }
            _ => {}
        }
    }
    found.extend(from.map(|begin| begin..line.len()));
    found
}

fn check(text: &str, out: Option<&Path>) -> u8 {
    let (status, line) = rehearse(text, out);
    match status {
        0 => assert_eq!(line, ""),
        2 | 3 => super::check_line(&line),
        _ => panic!("status {status}: {line}"),
    }
    let Some(out) = out else {
        return status;
    };
    if status == 2 {
        let left = fs::read_dir(out).map_or(0, Iterator::count);
        assert_eq!(left, 0, "{line}: something is written all the same");
        return status;
    }
    for name in ["final.csv", "preview.svg", "report.json"] {
        let written = fs::read_to_string(out.join(name)).expect(name);
        for word in ["NaN", "nan", "inf,", "inf "] {
            assert!(!written.contains(word), "{name} has {word}: {written}");
        }
    }
    status
}
