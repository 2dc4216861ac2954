//! The results of a run: written beside the old ones, exchanged with them at once.

use crate::digest::{Digest, Sum};
use crate::journal::{self, JOURNAL, Journal, Move, NEW, OLD, exists};
use crate::lock::Lock;
use crate::manifest::{MANIFEST, Manifest};
use crate::{Disk, FilesError, Output, Waiting};
use std::collections::BTreeSet;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

/// A folder of results while a run writes new ones.
///
/// The folder is locked. New results lie beside the old ones until [`Results::exchange`]; whatever happens before, the old
/// ones stand as they are. What a file of a result's name holds that is no result, or was changed since, is set aside
/// under another name, never replaced.
#[derive(Debug)]
pub struct Results {
    disk: Arc<dyn Disk>,
    folder: PathBuf,
    /// Every name that a result may have.
    names: &'static [&'static str],
    ready: Vec<Ready>,
    lasting: Option<PathBuf>,
    is_worth_keeping: bool,
    // Last, so that it is let go of when everything else is done.
    _lock: Lock,
}

/// A result that is whole.
#[derive(Debug)]
struct Ready {
    /// Where it lies, from the folder on.
    from: String,
    name: String,
    digest: Digest,
}

/// A result that is being written.
pub struct Growing {
    file: BufWriter<Box<dyn Output>>,
    sum: Sum,
    from: String,
    name: String,
}

/// What became of an exchange.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exchanged {
    /// The results, in the order in which they were written.
    pub written: Vec<PathBuf>,
    /// Where files went that had a result's name and were none.
    pub set_aside: Vec<PathBuf>,
    /// Recordings that earlier runs left unfinished.
    pub unfinished: Vec<PathBuf>,
}

impl Results {
    /// Takes the folder, which is made if it is not there, for one run.
    ///
    /// An exchange that a killed run began is ended first. `waiting` says whether to wait for another run as long as it
    /// returns true; `None` does not wait.
    ///
    /// # Errors
    /// [`FilesError::Busy`] and [`FilesError::Interrupted`] while another run has the folder, [`FilesError::Refused`].
    pub fn begin(
        disk: Arc<dyn Disk>,
        folder: &Path,
        names: &'static [&'static str],
        waiting: Waiting<'_>,
    ) -> Result<Self, FilesError> {
        disk.create_folder(folder)
            .map_err(FilesError::refused("make the folder", folder))?;
        let lock = Lock::take(Arc::clone(&disk), folder, waiting)?;
        journal::finish(&*disk, folder)?;
        let new = folder.join(NEW);
        disk.create_folder(&new)
            .map_err(FilesError::refused("make the folder", &new))?;
        Ok(Self {
            disk,
            folder: folder.to_path_buf(),
            names,
            ready: Vec::new(),
            lasting: None,
            is_worth_keeping: false,
            _lock: lock,
        })
    }

    /// Begins a result; nobody sees it before the exchange.
    ///
    /// # Errors
    /// [`FilesError::Refused`].
    pub fn create(&self, name: &str) -> Result<Growing, FilesError> {
        self.grow(format!("{NEW}/{name}"), name)
    }

    /// Begins a result that is worth having unfinished, too: until the exchange it lies in the folder as
    /// `STEM.partial-TIME.ENDING` and stays there when the run ends without one, once [`Results::keep_partial`] was
    /// called, or when it is killed.
    ///
    /// # Errors
    /// [`FilesError::Refused`].
    pub fn create_lasting(&mut self, name: &str) -> Result<Growing, FilesError> {
        let (stem, ending) = parts(name);
        let time = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
        let time = time.replace(['-', ':'], "");
        // The clock may have been set back, so the time alone is no name of its own.
        let from = self.free_name(|number| match number {
            1 => format!("{stem}{PARTIAL}{time}.{ending}"),
            number => format!("{stem}{PARTIAL}{time}-{number}.{ending}"),
        })?;
        let growing = self.grow(from.clone(), name)?;
        self.lasting = Some(self.folder.join(from));
        Ok(growing)
    }

    /// The lasting result holds something by now that somebody may want.
    pub fn keep_partial(&mut self) {
        self.is_worth_keeping = true;
    }

    /// Where the lasting result lies until the exchange.
    pub fn partial(&self) -> Option<&Path> {
        self.lasting.as_deref()
    }

    /// Writes a whole result.
    ///
    /// # Errors
    /// [`FilesError::Refused`].
    pub fn write(&mut self, name: &str, content: &[u8]) -> Result<(), FilesError> {
        let mut growing = self.create(name)?;
        growing
            .write_all(content)
            .map_err(FilesError::refused("write", &self.folder.join(name)))?;
        self.seal(growing)
    }

    /// A result is whole.
    ///
    /// # Errors
    /// [`FilesError::Refused`].
    pub fn seal(&mut self, mut growing: Growing) -> Result<(), FilesError> {
        growing
            .file
            .flush()
            .and_then(|()| growing.file.get_mut().sync())
            .map_err(FilesError::refused(
                "write",
                &self.folder.join(&growing.name),
            ))?;
        self.ready.push(Ready {
            digest: growing.sum.digest(),
            from: growing.from,
            name: growing.name,
        });
        Ok(())
    }

    /// The results take the place of those of the run before, all at once: names of results that this run does not have
    /// are free then.
    ///
    /// # Errors
    /// [`FilesError::Refused`]; the old results stand as they were.
    pub fn exchange(mut self) -> Result<Exchanged, FilesError> {
        let written = self.ready.iter().map(|one| self.folder.join(&one.name));
        let written = written.collect();
        let Plan {
            journal,
            replaced,
            set_aside,
        } = self.plan()?;
        self.keep_old(&replaced)?;
        let (disk, folder) = (&*self.disk, self.folder.as_path());
        let new = folder.join(NEW);
        let sync = |folder: &Path| {
            disk.sync_folder(folder)
                .map_err(FilesError::refused("write into", folder))
        };
        sync(&new)?;
        // From the moment the journal has its name the exchange will be ended, by whoever comes next.
        let draft = new.join(JOURNAL);
        write_through(disk, &draft, journal.text().as_bytes())
            .map_err(FilesError::refused("write", &draft))?;
        disk.rename(&draft, &folder.join(JOURNAL))
            .map_err(FilesError::refused("write", &folder.join(JOURNAL)))?;
        sync(folder)?;
        journal.carry_out(disk, folder, &replaced)?;
        self.lasting = None;
        // The new results stand. What fails from here on the next run makes good.
        let ended = disk
            .sync_folder(folder)
            .and_then(|()| disk.remove_file(&folder.join(JOURNAL)));
        if let Err(error) = ended {
            tracing::warn!(%error, folder = %folder.display(), "the results stand; the exchange's journal could not be taken away");
        }
        Ok(Exchanged {
            written,
            set_aside,
            unfinished: self.unfinished(),
        })
    }

    /// What to do with everything that has a result's name. Each old result is read once, to see whether it is one: what is
    /// decided here holds for all that follows.
    fn plan(&mut self) -> Result<Plan, FilesError> {
        let (disk, folder) = (&*self.disk, self.folder.as_path());
        let known = Manifest::read(disk, folder)?;
        let mut manifest = Manifest::default();
        let (mut asides, mut set_aside, mut intos) = (Vec::new(), Vec::new(), Vec::new());
        let mut replaced = BTreeSet::new();
        for &name in self.names {
            let path = folder.join(name);
            let is_there = exists(disk, &path).map_err(FilesError::refused("look at", &path))?;
            let is_new = self.ready.iter().any(|one| one.name == name);
            if !is_there {
                continue;
            }
            let from = name.to_owned();
            if !known.holds(disk, folder, name) {
                let (stem, ending) = parts(name);
                let to = self.free_name(|number| format!("{stem}.kept-{number}.{ending}"))?;
                set_aside.push(folder.join(&to));
                asides.push(Move::Aside { from, to });
            } else if is_new {
                replaced.insert(from);
            } else {
                let to = format!("{OLD}/{name}");
                asides.push(Move::Aside { from, to });
            }
        }
        let old_manifest = folder.join(MANIFEST);
        if exists(disk, &old_manifest).map_err(FilesError::refused("look at", &old_manifest))? {
            replaced.insert(MANIFEST.to_owned());
        }
        for one in &self.ready {
            manifest.insert(&one.name, one.digest);
            let (from, to) = (one.from.clone(), one.name.clone());
            intos.push(Move::Into { from, to });
        }
        self.write(MANIFEST, manifest.text().as_bytes())?;
        let (from, to) = (format!("{NEW}/{MANIFEST}"), MANIFEST.to_owned());
        intos.push(Move::Into { from, to });
        asides.extend(intos);
        Ok(Plan {
            journal: Journal { moves: asides },
            replaced,
            set_aside,
        })
    }

    /// Gives old results that will be replaced a second name.
    fn keep_old(&self, replaced: &BTreeSet<String>) -> Result<(), FilesError> {
        let disk = &*self.disk;
        let old = self.folder.join(OLD);
        disk.create_folder(&old)
            .map_err(FilesError::refused("make the folder", &old))?;
        for name in replaced {
            let (path, second) = (self.folder.join(name), old.join(name));
            // Some file systems know no second names.
            disk.link(&path, &second)
                .or_else(|_| copy(disk, &path, &second))
                .map_err(FilesError::refused("keep the old result", &path))?;
        }
        Ok(())
    }

    fn grow(&self, from: String, name: &str) -> Result<Growing, FilesError> {
        debug_assert!(
            name == MANIFEST || self.names.contains(&name),
            "{name} is declared"
        );
        let file = self
            .disk
            .create(&self.folder.join(&from))
            .map_err(FilesError::refused("write", &self.folder.join(name)))?;
        Ok(Growing {
            file: BufWriter::new(file),
            sum: Sum::default(),
            from,
            name: name.to_owned(),
        })
    }

    /// The first of `names`, by number from 1, that nothing in the folder has.
    fn free_name(&self, names: impl Fn(u32) -> String) -> Result<String, FilesError> {
        for number in 1.. {
            let name = names(number);
            let path = self.folder.join(&name);
            if !exists(&*self.disk, &path).map_err(FilesError::refused("look at", &path))? {
                return Ok(name);
            }
        }
        unreachable!("a folder holds fewer files than there are numbers")
    }

    /// What runs that came to no end left; a folder that cannot be read tells none.
    fn unfinished(&self) -> Vec<PathBuf> {
        let mut found = self.disk.entries(&self.folder).unwrap_or_default();
        found.retain(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            self.names.iter().any(|result| {
                let (stem, ending) = parts(result);
                name.strip_prefix(stem)
                    .and_then(|rest| rest.strip_prefix(PARTIAL)?.strip_suffix(ending))
                    // What a recovery kept beside has one more part.
                    .is_some_and(|time| !time.trim_end_matches('.').contains('.'))
            })
        });
        found.sort();
        found
    }
}

/// How an exchange is to go.
struct Plan {
    journal: Journal,
    /// Old results in whose place a new one comes.
    replaced: BTreeSet<String>,
    /// Where files go that are no results.
    set_aside: Vec<PathBuf>,
}

/// Stem and ending of a result's name.
fn parts(name: &str) -> (&str, &str) {
    name.rsplit_once('.').unwrap_or((name, ""))
}

/// Between the stem of a lasting result's name and the time at which it was begun.
const PARTIAL: &str = ".partial-";

impl Drop for Results {
    fn drop(&mut self) {
        // Only what this run put there; a journal says that it is needed still.
        let disk = &*self.disk;
        if !exists(disk, &self.folder.join(JOURNAL)).unwrap_or(true) {
            for name in [NEW, OLD] {
                if let Err(error) = journal::clear(disk, &self.folder.join(name)) {
                    tracing::debug!(%error, "the next run takes away what is left");
                }
            }
        }
        if let Some(path) = self.lasting.take().filter(|_| !self.is_worth_keeping) {
            disk.remove_file(&path).ok();
        }
    }
}

impl Write for Growing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let length = self.file.write(bytes)?;
        self.sum.add(&bytes[..length]);
        Ok(length)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Makes a file whose content stands on the medium.
fn write_through(disk: &dyn Disk, path: &Path, content: &[u8]) -> io::Result<()> {
    let mut file = disk.create(path)?;
    file.write_all(content)?;
    file.flush()?;
    file.sync()
}

fn copy(disk: &dyn Disk, from: &Path, to: &Path) -> io::Result<()> {
    let mut file = disk.create(to)?;
    io::copy(&mut disk.open(from)?, &mut file)?;
    file.sync()
}
