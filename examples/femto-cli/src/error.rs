//! What can go wrong, each as one line that names the file, the key and the value.

use std::path::PathBuf;

/// Of a process that ends with an error: 3 is a refused step, which is none.
pub const EXIT_STATUS: u8 = 2;

#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The scene file is not TOML, or not a scene.
    #[error("{file}: {what}")]
    Scene { file: String, what: String },

    /// A value of the scene file is out of range or does not work.
    #[error("{file}: {key} = {value}: {why}")]
    Value {
        file: String,
        key: String,
        value: String,
        why: String,
    },

    /// A mesh file, outside a scene.
    #[error("{file}: {what}")]
    Mesh { file: String, what: String },

    /// An option of the command line.
    #[error("{option} {value}: {why}")]
    Option {
        option: &'static str,
        value: String,
        why: String,
    },

    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        path: PathBuf,
        source: std::io::Error,
    },

    /// DIR cannot be made.
    #[error("--out {}: cannot be made: {source}", path.display())]
    Out {
        path: PathBuf,
        source: std::io::Error,
    },

    /// A result cannot be written after the run has begun: a full disk, say.
    #[error("{}: cannot be written: {source}", path.display())]
    Write {
        path: PathBuf,
        source: std::io::Error,
    },
}

/// Folds a text to one line without control characters, so that a strange file cannot
/// break an error message in two.
pub fn one_line(text: &str) -> String {
    const LIMIT: usize = 600;
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() {
            line.push(' ');
        }
        for c in word.chars() {
            if c.is_control() {
                line.extend(c.escape_default());
            } else {
                line.push(c);
            }
        }
        if line.len() > LIMIT {
            line.push_str(" ...");
            break;
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::one_line;

    #[test]
    fn folds_and_escapes() {
        assert_eq!(one_line("a\n  b\tc"), "a b c");
        assert_eq!(one_line("a\u{1b}[2J"), "a\\u{1b}[2J");
        assert!(one_line(&"x ".repeat(10_000)).len() < 700);
    }
}
