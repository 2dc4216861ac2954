//! The line to a browser: its DevTools protocol, a question and an answer at a time, as JSON over a web socket.
//! What there is to ask: <https://chromedevtools.github.io/devtools-protocol/>.

use serde_json::{Value, json};
use std::net::TcpStream;
use std::time::Duration;
use tungstenite::{Message, WebSocket};

/// Longest that is waited for an answer, or for something to show: a test of one effect on a machine that does something else. Chosen.
pub const PATIENCE: Duration = Duration::from_secs(120);

/// To the browser, or to one page in it.
pub struct DevTools {
    socket: WebSocket<TcpStream>,
    asked: u64,
    /// What happened so far.
    events: Vec<Event>,
}

/// Something that happened without having been asked for.
pub struct Event {
    pub method: String,
    pub params: Value,
}

impl DevTools {
    /// What listens at `path` of a browser's port.
    pub fn at(port: u16, path: &str) -> Self {
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let address = format!("ws://127.0.0.1:{port}{path}");
        let (socket, _) = tungstenite::client(address, stream).unwrap();
        Self {
            socket,
            asked: 0,
            events: Vec::new(),
        }
    }

    /// The answer to a question, or what the browser has against it.
    pub fn asked(&mut self, method: &str, params: &Value) -> Result<Value, Value> {
        self.asked += 1;
        let question = json!({"id": self.asked, "method": method, "params": params}).to_string();
        self.socket.send(Message::text(question)).unwrap();
        loop {
            let message = self.socket.read().unwrap();
            // A ping or the like says nothing.
            let Ok(text) = message.to_text() else {
                continue;
            };
            let Ok(mut told) = serde_json::from_str::<Value>(text) else {
                continue;
            };
            if told["id"] == self.asked {
                return match told.get("error") {
                    Some(error) => Err(error.clone()),
                    None => Ok(told["result"].take()),
                };
            }
            if let Some(method) = told["method"].as_str().map(str::to_owned) {
                let params = told["params"].take();
                self.events.push(Event { method, params });
            }
        }
    }

    /// The answer to a question that there is nothing against.
    pub fn ask(&mut self, method: &str, params: &Value) -> Value {
        let told = self.asked(method, params);
        told.unwrap_or_else(|error| panic!("{method} {params}: {error}"))
    }

    /// What happened so far.
    pub fn events(&mut self) -> &[Event] {
        // Events come before the answer to what is asked after them.
        self.ask("Runtime.evaluate", &json!({"expression": "0"}));
        &self.events
    }
}
