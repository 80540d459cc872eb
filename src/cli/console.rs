//! Words to the terminal: colours only where they are seen and wanted, no panic when nobody listens.

use std::io::{ErrorKind, IsTerminal, Write};

use super::status::Problem;

/// Where a command speaks.
#[derive(Clone, Copy, Debug)]
pub struct Console {
    pub paint: Paint,
}

/// Colours, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paint {
    pub on: bool,
}

impl Console {
    /// Colours follow the standard output; `NO_COLOR` and a dumb terminal switch them off.
    pub fn from_environment() -> Console {
        let plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        Console {
            paint: Paint {
                on: std::io::stdout().is_terminal() && !plain && !dumb,
            },
        }
    }

    /// Writes to the standard output. A reader that has gone (`kynch list | head`) is no error.
    ///
    /// # Errors
    /// When the output cannot be written for any other reason, a full disk for one.
    pub fn say(&self, text: &str) -> Result<(), Problem> {
        let mut output = std::io::stdout().lock();
        let written = output.write_all(text.as_bytes()).and_then(|()| output.flush());
        match written {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error.into()),
            _ => Ok(()),
        }
    }

    /// Writes to the standard error, where there is nobody left to tell that it failed.
    pub fn complain(&self, text: &str) {
        let mut output = std::io::stderr().lock();
        let _ = output
            .write_all(text.as_bytes())
            .and_then(|()| output.write_all(b"\n"));
    }

    /// Tells what kept a command from its work. A study's errors come with their own excerpts.
    pub fn complain_about(&self, problem: &Problem) {
        match problem {
            Problem::Study(error) => self.complain(&error.to_string()),
            other => self.complain(&format!("kynch: {other}")),
        }
    }
}

impl Paint {
    pub fn green(self, text: &str) -> String {
        self.wrap("32", text)
    }

    pub fn red(self, text: &str) -> String {
        self.wrap("31", text)
    }

    pub fn yellow(self, text: &str) -> String {
        self.wrap("33", text)
    }

    pub fn bold(self, text: &str) -> String {
        self.wrap("1", text)
    }

    pub fn dim(self, text: &str) -> String {
        self.wrap("2", text)
    }

    fn wrap(self, code: &str, text: &str) -> String {
        if self.on {
            format!("\x1b[{code}m{text}\x1b[0m")
        } else {
            text.into()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_colours_the_text_is_left_alone() {
        assert_eq!(Paint { on: false }.red("x"), "x");
        assert_eq!(Paint { on: true }.red("x"), "\x1b[31mx\x1b[0m");
    }
}
