//! `snug workbench`: the page without a browser of its own, without cargo.

use crate::machine::{Machine, ended, fixture};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command};
use std::time::{Duration, Instant};

/// Longest that is waited for 24 tightenings to be read, on a machine that does something else. Chosen.
const PATIENCE: Duration = Duration::from_secs(60);

/// A program that runs, and is killed where a check fails.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        self.0.kill().ok();
    }
}

/// The page as it is now.
fn page(address: &str) -> String {
    let mut stream = TcpStream::connect(address).unwrap();
    let request = format!("GET / HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n");
    stream.write_all(request.as_bytes()).unwrap();
    let mut page = String::new();
    stream.read_to_string(&mut page).unwrap();
    assert!(page.starts_with("HTTP/1.1 200 OK\r\n"), "{page}");
    page
}

#[test]
fn the_page_is_served_until_it_is_ended() {
    let machine = Machine::new();
    let data = fixture("mystery");
    let words = [
        "workbench",
        "--no-open",
        "--port",
        "0",
        "--data",
        data.to_str().unwrap(),
    ];
    let mut running = Running(machine.snug(&words).spawn().unwrap());
    let mut line = String::new();
    BufReader::new(running.0.stdout.take().unwrap())
        .read_line(&mut line)
        .unwrap();
    let address = (line.strip_prefix("The workbench is at http://"))
        .and_then(|rest| rest.strip_suffix("/; Ctrl-C ends it.\n"))
        .unwrap_or_else(|| panic!("{line:?}"));
    // Switches come when the tightenings have been read.
    let started = Instant::now();
    while !page(address).contains("stretch_reflex") {
        assert!(started.elapsed() < PATIENCE, "the page has no switches");
        std::thread::sleep(Duration::from_millis(100));
    }
    let end = Command::new("kill")
        .args(["-TERM", &running.0.id().to_string()])
        .status();
    assert!(end.unwrap().success());
    assert!(running.0.wait().unwrap().success());
}

#[test]
fn a_taken_port_and_a_wrong_study_are_told() {
    let machine = Machine::new();
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let data = fixture("mystery");
    let words = [
        "workbench",
        "--no-open",
        "--port",
        &port,
        "--data",
        data.to_str().unwrap(),
    ];
    let (code, said, told) = ended(&mut machine.snug(&words));
    assert_eq!((code, said.as_str()), (1, ""));
    assert!(told.starts_with(&format!("port {port} is taken")), "{told}");
    std::fs::write(machine.path("work/rig.ron"), "(modl: ())").unwrap();
    let words = ["workbench", "--no-open", "--study", "rig.ron"];
    let (code, said, told) = ended(&mut machine.snug(&words));
    assert_eq!((code, said.as_str()), (2, ""), "{told}");
    assert!(told.contains("modl"), "{told}");
}
