//! As much of a browser as the stories need: requests, and a page that listens.

use serde_json::Value;
use snug_study::Study;
use snug_workbench::{Bench, Doors, runtime, serve};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Longest that is waited for an event: a fit of 24 tightenings on a machine that does something else. Chosen.
const PATIENCE: Duration = Duration::from_secs(120);

/// A workbench on the mystery that ships with Snug, for as long as the process lives; its port.
pub fn workbench() -> u16 {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/mystery");
    let bench = Bench::new(Study::on(data), None);
    let reader = Arc::clone(&bench);
    let (port_of, port) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        let runtime = runtime().unwrap();
        runtime.block_on(async {
            let doors = Doors::open(0).await.unwrap();
            port_of.send(doors.port()).unwrap();
            serve(doors, bench).await.unwrap();
        });
    });
    let port = port.recv().unwrap();
    std::thread::spawn(move || reader.read());
    let mut reading = Events::listen(port, "/api/reading");
    reading.until("ready");
    port
}

fn connected(port: u16, request: &str) -> TcpStream {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream.write_all(request.as_bytes()).unwrap();
    stream
}

/// Status and body of an answer, whatever headers the request has.
pub fn asked(port: u16, request: &str) -> (u16, String) {
    let mut answer = String::new();
    connected(port, request)
        .read_to_string(&mut answer)
        .unwrap();
    let status = answer.split(' ').nth(1).unwrap().parse().unwrap();
    let (_, body) = answer.split_once("\r\n\r\n").unwrap();
    (status, body.to_owned())
}

pub fn get(port: u16, path: &str) -> (u16, String) {
    asked(
        port,
        &format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n"),
    )
}

pub fn post(port: u16, path: &str, body: &Value) -> (u16, String) {
    let body = body.to_string();
    asked(
        port,
        &format!(
            "POST {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\nContent-Type: application/json\r\n\
             Content-Length: {}\r\n\r\n{body}",
            body.len()
        ),
    )
}

/// The events of a page.
pub struct Events(BufReader<TcpStream>);

impl Events {
    pub fn listen(port: u16, path: &str) -> Self {
        let request = format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n");
        Self(BufReader::new(connected(port, &request)))
    }

    fn next(&mut self) -> Value {
        loop {
            let mut line = String::new();
            assert!(self.0.read_line(&mut line).unwrap() > 0, "the events ended");
            if let Some(data) = line.strip_prefix("data: ") {
                return serde_json::from_str(data).unwrap();
            }
        }
    }

    /// Everything up to the first event of a kind, that one last.
    pub fn until(&mut self, kind: &str) -> Vec<Value> {
        let mut heard = Vec::new();
        loop {
            let event = self.next();
            let is_it = event["kind"] == kind;
            heard.push(event);
            if is_it {
                return heard;
            }
        }
    }
}
