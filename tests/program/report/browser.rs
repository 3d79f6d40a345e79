//! A browser without a window, spoken to by the Chrome DevTools Protocol.

use std::io::ErrorKind;
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;
use tungstenite::{Message, WebSocket};

/// What the distributions call it.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome-stable", "google-chrome"];

const ARGUMENTS: [&str; 10] = [
    "--headless",
    // Not to be had by root, nor in many containers; the page is the test's own.
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--disable-dev-shm-usage",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    // Some free port, which it writes into its folder.
    "--remote-debugging-port=0",
];

/// A machine that does much else starts a browser slowly.
const PATIENCE: Duration = Duration::from_secs(90);

/// One page of a browser, which ends with it.
pub struct Browser {
    process: Child,
    socket: WebSocket<TcpStream>,
    session: String,
    last_id: u64,
    /// All that the page told, in order.
    pub events: Vec<Value>,
    _folder: TempDir,
}

impl Browser {
    pub fn open() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let process = start(folder.path());
        let (stream, address) = connect(folder.path());
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let (socket, _) = tungstenite::client(address, stream).expect("the browser speaks WebSocket");
        let mut browser =
            Self { process, socket, session: String::new(), last_id: 0, events: Vec::new(), _folder: folder };
        let target = browser.call("Target.createTarget", json!({"url": "about:blank"}))["targetId"].clone();
        let attached = browser.call("Target.attachToTarget", json!({"targetId": target, "flatten": true}));
        browser.session = attached["sessionId"].as_str().unwrap().to_owned();
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser
    }

    /// Pixels of the window.
    pub fn resize(&mut self, width: u32, height: u32) {
        let size = json!({"width": width, "height": height, "deviceScaleFactor": 1, "mobile": false});
        self.call("Emulation.setDeviceMetricsOverride", size);
    }

    /// Returns when the page is there with all that it has.
    pub fn visit(&mut self, url: &str) {
        let visited = self.call("Page.navigate", json!({"url": url}));
        assert!(visited["errorText"].is_null(), "{visited}");
        while !self.events.iter().any(|event| event["method"] == "Page.loadEventFired") {
            self.listen();
        }
    }

    /// The value of a JavaScript expression.
    #[track_caller]
    pub fn evaluate(&mut self, expression: &str) -> Value {
        let answer = self.call("Runtime.evaluate", json!({"expression": expression, "returnByValue": true}));
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    /// The parameters of all events that are called so.
    pub fn events_of<'a>(&'a self, method: &'a str) -> impl Iterator<Item = &'a Value> {
        self.events.iter().filter(move |event| event["method"] == method).map(|event| &event["params"])
    }

    fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.last_id += 1;
        let id = self.last_id;
        let mut call = json!({"id": id, "method": method, "params": parameters});
        if !self.session.is_empty() {
            call["sessionId"] = self.session.clone().into();
        }
        self.socket.send(Message::text(call.to_string())).expect("the browser listens");
        loop {
            if let Some(answer) = self.listen().filter(|answer| answer["id"] == id) {
                assert!(answer["error"].is_null(), "{method}: {answer}");
                return answer["result"].clone();
            }
        }
    }

    /// Waits for the next message; an event is kept, an answer returned.
    fn listen(&mut self) -> Option<Value> {
        let message = self.socket.read().expect("the browser answers");
        let Message::Text(text) = message else { return None };
        let message: Value = serde_json::from_str(text.as_str()).unwrap();
        if message["id"].is_null() {
            self.events.push(message);
            return None;
        }
        Some(message)
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn start(folder: &Path) -> Child {
    for name in NAMES {
        let process = Command::new(name)
            .args(ARGUMENTS)
            .arg(format!("--user-data-dir={}", folder.display()))
            .arg("about:blank")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn();
        match process {
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            process => return process.unwrap_or_else(|error| panic!("could not start {name}: {error}")),
        }
    }
    panic!("this test needs a browser, one of {NAMES:?}; ./setup.sh installs one");
}

/// The browser's port, and its address there.
fn connect(folder: &Path) -> (TcpStream, String) {
    let start = Instant::now();
    loop {
        let lines = std::fs::read_to_string(folder.join("DevToolsActivePort")).unwrap_or_default();
        if let Some((port, path)) = lines.split_once('\n').filter(|(_, path)| !path.is_empty()) {
            let stream = TcpStream::connect(("127.0.0.1", port.parse().unwrap())).expect("the browser listens");
            return (stream, format!("ws://127.0.0.1:{port}{}", path.trim()));
        }
        assert!(start.elapsed() < PATIENCE, "the browser did not start");
        sleep(Duration::from_millis(50));
    }
}
