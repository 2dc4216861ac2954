//! A headless Chromium, and a page of the workbench in it.

use crate::devtools::{DevTools, PATIENCE};
use serde_json::{Value, json};
use std::cell::RefCell;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Between two looks at what is waited for.
const A_MOMENT: Duration = Duration::from_millis(20);

/// The browser that `SNUG_CHROMIUM` names, which then must be there, or one that is found on the path.
pub fn installed() -> Option<PathBuf> {
    if let Some(named) = std::env::var_os("SNUG_CHROMIUM") {
        let path = PathBuf::from(named);
        assert!(path.is_file(), "SNUG_CHROMIUM = {path:?} is no file");
        return Some(path);
    }
    let folders = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let found = std::env::split_paths(&folders)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|path| path.is_file());
    if found.is_none() {
        println!("skipped: no Chromium is installed");
    }
    found
}

/// One browser at a time: what is timed in it has the machine for itself.
static ALONE: Mutex<()> = Mutex::new(());

/// A browser without a window, for as long as the value lives.
pub struct Headless {
    line: RefCell<DevTools>,
    port: u16,
    process: Child,
    _profile: TempDir,
    _alone: MutexGuard<'static, ()>,
}

impl Headless {
    pub fn launch(program: PathBuf) -> Self {
        let alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let profile = TempDir::new().unwrap();
        let process = Command::new(program)
            .args(["--headless=new", "--no-sandbox", "--no-first-run"])
            .args(["--disable-background-networking", "--disable-extensions"])
            .arg("--remote-debugging-port=0")
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let told = profile.path().join("DevToolsActivePort");
        let begun = Instant::now();
        let (port, path) = loop {
            let text = std::fs::read_to_string(&told).unwrap_or_default();
            if let Some((port, path)) = text.split_once('\n') {
                break (port.parse().unwrap(), path.to_owned());
            }
            assert!(begun.elapsed() < PATIENCE, "the browser never listened");
            sleep(A_MOMENT);
        };
        Self {
            line: RefCell::new(DevTools::at(port, &path)),
            port,
            process,
            _profile: profile,
            _alone: alone,
        }
    }

    /// A page as wide as that, at an address.
    pub fn open(&self, address: &str, width: i64, scheme: &str) -> Tab {
        let mut line = self.line.borrow_mut();
        let target = line.ask("Target.createTarget", &json!({"url": "about:blank"}));
        let id = target["targetId"].as_str().unwrap();
        let line = RefCell::new(DevTools::at(self.port, &format!("/devtools/page/{id}")));
        let tab = Tab { line };
        for watched in ["Network.enable", "Page.enable", "Runtime.enable"] {
            tab.ask(watched, &json!({}));
        }
        tab.ask(
            "Emulation.setDeviceMetricsOverride",
            &json!({"width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": width < 600}),
        );
        tab.ask(
            "Emulation.setEmulatedMedia",
            &json!({"features": [{"name": "prefers-color-scheme", "value": scheme}]}),
        );
        tab.goto(address);
        tab
    }

    pub fn close(mut self) {
        self.line.get_mut().ask("Browser.close", &json!({}));
        self.process.wait().unwrap();
    }
}

impl Drop for Headless {
    /// A story that failed leaves no browser behind.
    fn drop(&mut self) {
        self.process.kill().ok();
        self.process.wait().ok();
    }
}

/// One page.
pub struct Tab {
    line: RefCell<DevTools>,
}

impl Tab {
    /// The answer of the page's DevTools to a question.
    pub fn ask(&self, method: &str, params: &Value) -> Value {
        self.line.borrow_mut().ask(method, params)
    }

    /// Goes to an address; what is there may still be loading.
    pub fn goto(&self, address: &str) {
        self.ask("Page.navigate", &json!({"url": address}));
    }

    /// Shows the page before the others, as what is timed and clicked must be.
    pub fn to_front(&self) {
        self.ask("Page.bringToFront", &json!({}));
    }

    /// The same address anew; what is there may still be loading.
    pub fn reload(&self) {
        self.value("window.isLeft = true");
        self.ask("Page.reload", &json!({}));
        self.until("window.isLeft === undefined");
    }

    /// What an expression of the page comes to; nothing while another page is being loaded.
    pub fn value(&self, expression: &str) -> Value {
        let question =
            json!({"expression": expression, "returnByValue": true, "awaitPromise": true});
        let told = self.line.borrow_mut().asked("Runtime.evaluate", &question);
        told.map_or(Value::Null, |mut told| told["result"]["value"].take())
    }

    /// The text of the element with this data attribute; nothing where it is not there.
    pub fn text(&self, name: &str) -> String {
        let text = self.value(&format!(
            "document.querySelector('[data-{name}]')?.textContent ?? ''"
        ));
        text.as_str().unwrap_or("").replace('\u{a0}', " ")
    }

    /// Waits until an expression is true.
    pub fn until(&self, expression: &str) {
        let begun = Instant::now();
        while self.value(expression) != Value::Bool(true) {
            assert!(begun.elapsed() < PATIENCE, "it never came to {expression}");
            sleep(A_MOMENT);
        }
    }

    /// Waits until the error on the page is that.
    pub fn error_is(&self, error: &str) {
        self.until(&format!(
            "document.querySelector('[data-error]')?.textContent === '{error}'"
        ));
    }

    /// Waits until the study's own model is fitted, its error said, and everything that follows from it.
    pub fn is_ready(&self, error: &str) {
        self.error_is(error);
        self.is_quiet();
    }

    /// Waits until all that follows from a fit is told but the tests of what was added, which go on behind the next click.
    pub fn is_quiet(&self) {
        self.until("(document.querySelector('[data-usable]')?.textContent ?? '') !== ''");
    }

    /// Waits until no fit is under way.
    pub fn has_fitted(&self) {
        self.until("!document.body.classList.contains('fitting')");
    }

    /// Gives an element the focus.
    pub fn focus(&self, selector: &str) {
        let has_it = self.value(&format!(
            "(() => {{ const one = document.querySelector({selector:?}); one.focus(); return document.activeElement === one; }})()"
        ));
        assert_eq!(has_it, true, "{selector}");
    }

    /// Where an element is on screen, once it is scrolled there: left, top, width and height \[px\].
    fn place(&self, selector: &str) -> [f64; 4] {
        let place = self.value(&format!(
            "(() => {{
               const one = document.querySelector({selector:?});
               one.scrollIntoView({{ block: 'center', inline: 'center', behavior: 'instant' }});
               const {{ x, y, width, height }} = one.getBoundingClientRect();
               return [x, y, width, height];
             }})()"
        ));
        let told = serde_json::from_value(place);
        told.unwrap_or_else(|_| panic!("{selector} is not there"))
    }

    /// What the mouse does at a point.
    fn mouse(&self, kind: &str, x: f64, y: f64) {
        self.ask(
            "Input.dispatchMouseEvent",
            &json!({"type": kind, "x": x, "y": y, "button": "left", "buttons": 1, "clickCount": 1}),
        );
    }

    /// Clicks where a person would: in the middle of what is on screen, which nothing may cover.
    pub fn click(&self, selector: &str) {
        self.to_front();
        let [left, top, width, height] = self.place(selector);
        let (x, y) = (left + 0.5 * width, top + 0.5 * height);
        let is_on_top = self.value(&format!(
            "document.querySelector({selector:?}).contains(document.elementFromPoint({x}, {y}))"
        ));
        assert_eq!(is_on_top, true, "{selector} is covered");
        for kind in ["mouseMoved", "mousePressed", "mouseReleased"] {
            self.mouse(kind, x, y);
        }
    }

    /// Presses a key, whatever has the focus.
    pub fn press(&self, key: &str) {
        let (number, text) = match key {
            "Tab" => (9, ""),
            "Enter" => (13, "\r"),
            "ArrowRight" => (39, ""),
            " " => (32, " "),
            other => panic!("no story presses {other}"),
        };
        let code = if key == " " { "Space" } else { key };
        for (kind, text) in [("keyDown", text), ("keyUp", "")] {
            let event = json!({"type": kind, "key": key, "code": code, "windowsVirtualKeyCode": number, "text": text});
            self.ask("Input.dispatchKeyEvent", &event);
        }
    }

    /// Drags across the first figure, between two shares of its width.
    pub fn drag(&self, from: f64, to: f64) {
        let [left, top, width, height] = self.place("[data-panel] svg");
        for (kind, share) in [
            ("mouseMoved", from),
            ("mousePressed", from),
            ("mouseMoved", 0.5 * (from + to)),
            ("mouseMoved", to),
            ("mouseReleased", to),
        ] {
            self.mouse(kind, left + share * width, top + 0.5 * height);
        }
    }

    /// Nothing went wrong, and nothing was asked of another machine.
    pub fn was_well(&self, port: u16) {
        let mut line = self.line.borrow_mut();
        let (mut faults, mut asked) = (Vec::new(), Vec::new());
        for event in line.events() {
            match &*event.method {
                "Runtime.exceptionThrown" => faults.push(&event.params["exceptionDetails"]),
                "Runtime.consoleAPICalled" => faults.push(&event.params["args"]),
                "Network.requestWillBeSent" => {
                    asked.push(event.params["request"]["url"].as_str().unwrap());
                }
                _ => (),
            }
        }
        assert_eq!(faults, Vec::<&Value>::new());
        let own = format!("http://127.0.0.1:{port}/");
        // What every page asked for by now; its figures may still be on their way.
        let line = format!("{own}api/events?");
        assert!(asked.iter().any(|url| url.starts_with(&line)), "{asked:?}");
        let stranger = asked
            .iter()
            .find(|url| !url.starts_with(&own) && !url.starts_with("data:"));
        assert_eq!(stranger, None);
    }
}
