//! A workbench on the mystery that ships with Snug, which can be ended and begun again at the same port.

use snug_study::Study;
use snug_workbench::{Bench, Doors, runtime, serve};
use std::path::Path;
use std::sync::Arc;
use tokio::runtime::Runtime;

/// A server with a runtime of its own.
pub struct Server {
    runtime: Option<Runtime>,
    pub port: u16,
}

impl Server {
    /// Listens at `port`, or at any where that is 0; saves beside `study_file`.
    pub fn begin(port: u16, study_file: &Path) -> Self {
        let study = Study::read(study_file).unwrap();
        let bench = Bench::new(study, Some(study_file.to_owned()));
        let reader = Arc::clone(&bench);
        std::thread::spawn(move || reader.read());
        let runtime = runtime().unwrap();
        let (port_of, bound) = std::sync::mpsc::channel();
        runtime.spawn(async move {
            let doors = Doors::open(port).await.unwrap();
            port_of.send(doors.port()).unwrap();
            serve(doors, bench).await.unwrap();
        });
        Self {
            port: bound.recv().unwrap(),
            runtime: Some(runtime),
        }
    }

    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/", self.port)
    }

    pub fn end(mut self) {
        self.runtime.take().unwrap().shutdown_background();
    }
}

/// A study on the mystery, in a folder of its own.
pub fn study_in(folder: &Path) -> std::path::PathBuf {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/mystery");
    let data = data.canonicalize().unwrap();
    let path = folder.join("mystery.ron");
    std::fs::write(&path, format!("(source: (path: {data:?}))")).unwrap();
    path
}
