//! The renames by which new results take the place of old ones: all of them, or none.

use crate::{Disk, FilesError};
use std::collections::BTreeSet;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// The file that says, while results are exchanged, which renames belong together.
pub(crate) const JOURNAL: &str = ".snug-exchange";
/// The folder of new results until they are exchanged.
pub(crate) const NEW: &str = ".snug-new";
/// The folder of old results while they are exchanged.
pub(crate) const OLD: &str = ".snug-old";
/// Last line of a journal.
const END: &str = "end";
/// Longest journal that is read \[bytes\].
const LONGEST_BYTES: u64 = 1 << 20;

/// One rename; both names count from the folder of the results.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Move {
    /// What stands at `from` gives way: to `to`, where nothing is.
    Aside { from: String, to: String },
    /// A new result takes its name; an old one there has a second name among the old ones.
    Into { from: String, to: String },
}

impl Move {
    fn names(&self) -> (&str, &str) {
        match self {
            Self::Aside { from, to } | Self::Into { from, to } => (from, to),
        }
    }

    /// Whether it has been made.
    fn is_made(&self, disk: &dyn Disk, folder: &Path) -> io::Result<bool> {
        let there = |name: &str| exists(disk, &folder.join(name));
        match self {
            Self::Aside { from, to } => Ok(there(to)? || !there(from)?),
            Self::Into { from, .. } => Ok(!there(from)?),
        }
    }

    fn make(&self, disk: &dyn Disk, folder: &Path) -> io::Result<()> {
        let (from, to) = self.names();
        disk.rename(&folder.join(from), &folder.join(to))
    }

    /// Takes it back; `kept` are the names whose old results have a second name.
    fn take_back(&self, disk: &dyn Disk, folder: &Path, kept: &BTreeSet<String>) -> io::Result<()> {
        let (from, to) = self.names();
        match self {
            Self::Into { .. } if kept.contains(to) => {
                disk.rename(&folder.join(OLD).join(to), &folder.join(to))
            }
            _ => disk.rename(&folder.join(to), &folder.join(from)),
        }
    }
}

/// The renames of one exchange, in order.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Journal {
    pub moves: Vec<Move>,
}

impl Journal {
    /// What the text of a journal says; `None` for any other text.
    fn parse(text: &str) -> Option<Self> {
        let (body, end) = text.trim_end().rsplit_once('\n')?;
        let moves = body.lines().map(|line| {
            let mut words = line.split('\t');
            let kind = words.next()?;
            let (from, to) = (words.next()?.to_owned(), words.next()?.to_owned());
            match kind {
                "aside" => Some(Move::Aside { from, to }),
                "into" => Some(Move::Into { from, to }),
                _ => None,
            }
        });
        let moves = moves.collect::<Option<_>>()?;
        (end == END).then_some(Self { moves })
    }

    pub fn text(&self) -> String {
        let mut text = String::new();
        for one in &self.moves {
            let kind = match one {
                Move::Aside { .. } => "aside",
                Move::Into { .. } => "into",
            };
            let (from, to) = one.names();
            text.push_str(&format!("{kind}\t{from}\t{to}\n"));
        }
        text + END + "\n"
    }

    /// Makes every move, or takes back those made when one fails.
    ///
    /// # Errors
    /// [`FilesError::Refused`]; the old results stand then, unless taking back failed, too: the journal stays in that
    /// case, and [`finish`] ends the exchange.
    pub fn carry_out(
        &self,
        disk: &dyn Disk,
        folder: &Path,
        kept: &BTreeSet<String>,
    ) -> Result<(), FilesError> {
        for (done, one) in self.moves.iter().enumerate() {
            let Err(error) = one.make(disk, folder) else {
                continue;
            };
            let made = self.moves[..done].iter().rev();
            let back: io::Result<()> = made
                .map(|made| made.take_back(disk, folder, kept))
                .collect::<io::Result<Vec<()>>>()
                .and_then(|_| disk.remove_file(&folder.join(JOURNAL)));
            if let Err(error) = back {
                tracing::error!(%error, folder = %folder.display(), "the exchange of results stopped halfway; the next run into this folder ends it");
            }
            let path = folder.join(one.names().1);
            return Err(FilesError::refused("put the new result into place:", &path)(error));
        }
        Ok(())
    }
}

/// Ends an exchange that a killed run began, and takes away what it left. Nothing to do is the rule.
///
/// # Errors
/// [`FilesError::Refused`].
pub(crate) fn finish(disk: &dyn Disk, folder: &Path) -> Result<(), FilesError> {
    let path = folder.join(JOURNAL);
    let mut text = String::new();
    let read = match disk.open(&path) {
        Ok(file) => file
            .take(LONGEST_BYTES)
            .read_to_string(&mut text)
            .map(|_| true),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
    };
    if read.map_err(FilesError::refused("read", &path))? {
        let journal = Journal::parse(&text).unwrap_or_default();
        for one in &journal.moves {
            let made = one.is_made(disk, folder);
            let to = folder.join(one.names().1);
            made.and_then(|made| match made {
                true => Ok(()),
                false => one.make(disk, folder),
            })
            .map_err(FilesError::refused("put the new result into place:", &to))?;
        }
        disk.sync_folder(folder)
            .and_then(|()| disk.remove_file(&path))
            .map_err(FilesError::refused(
                "end the exchange of results in",
                folder,
            ))?;
        tracing::info!(folder = %folder.display(), "ended the exchange of results that a stopped run had begun");
    }
    for name in [NEW, OLD] {
        let inner = folder.join(name);
        clear(disk, &inner).map_err(FilesError::refused("take away", &inner))?;
    }
    Ok(())
}

/// Takes away a folder of files, if it is there; a link to one is no such folder.
pub(crate) fn clear(disk: &dyn Disk, folder: &Path) -> io::Result<()> {
    match disk.link_metadata(folder) {
        Ok(metadata) if metadata.is_dir() => {}
        Ok(_) => return Err(ErrorKind::NotADirectory.into()),
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(error),
    }
    for entry in disk.entries(folder)? {
        disk.remove_file(&entry)?;
    }
    disk.remove_folder(folder)
}

/// Whether a name is taken, be it by a link that leads nowhere.
pub(crate) fn exists(disk: &dyn Disk, path: &Path) -> io::Result<bool> {
    match disk.link_metadata(path) {
        Ok(_) => Ok(true),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
    }
}
