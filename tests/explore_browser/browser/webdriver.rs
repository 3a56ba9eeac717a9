//! A client of `chromedriver`, by W3C's WebDriver: commands in JSON over HTTP, one connection each.

use std::fmt::Display;
use std::io::{ErrorKind, Read, Write};
use std::ops::Add;
use std::path::Path;
use std::time::Duration;

use serde_json::{Value, json};
use tokio::net::TcpStream;

/// Time limit of a command, also of a script that waits.
const LIMIT: Duration = Duration::from_secs(180);
/// Key of an element in JSON, defined by the standard.
const ELEMENT: &str = "element-6066-11e4-a52e-4f735466cecf";

/// Error message of the browser.
#[derive(Debug)]
pub struct Refused(String);

impl Display for Refused {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

pub type Answer<T> = Result<T, Refused>;

#[derive(Debug, Clone)]
pub struct WindowHandle(Value);

#[derive(Debug, Clone, Copy)]
pub enum Key {
    Tab = 0xe004,
    Enter = 0xe007,
    Control = 0xe009,
    Up = 0xe013,
    Right = 0xe014,
}

impl Key {
    fn character(self) -> char {
        char::from_u32(self as u32).expect("a character for private use")
    }
}

impl Add<&str> for Key {
    type Output = String;

    fn add(self, text: &str) -> String {
        format!("{}{text}", self.character())
    }
}

#[derive(Clone)]
pub struct WebDriver {
    port: u16,
    session: String,
}

impl WebDriver {
    pub async fn new(port: u16, options: Value) -> Answer<Self> {
        let timeouts = json!({ "script": 600_000, "pageLoad": 60_000, "implicit": 0 });
        let wishes = json!({ "capabilities": { "alwaysMatch": {
            "browserName": "chrome", "timeouts": timeouts, "goog:chromeOptions": options } } });
        let opened = command(port, "POST", "/session", Some(&wishes)).await?;
        let session = opened["sessionId"].as_str().expect("a session").to_owned();
        Ok(WebDriver { port, session })
    }

    async fn get(&self, what: &str) -> Answer<Value> {
        let path = format!("/session/{}/{what}", self.session);
        command(self.port, "GET", &path, None).await
    }

    async fn post(&self, what: &str, content: Value) -> Answer<Value> {
        let path = format!("/session/{}/{what}", self.session);
        command(self.port, "POST", &path, Some(&content)).await
    }

    pub async fn goto(&self, address: &str) -> Answer<()> {
        self.post("url", json!({ "url": address })).await.map(drop)
    }

    pub async fn refresh(&self) -> Answer<()> {
        self.post("refresh", json!({})).await.map(drop)
    }

    pub async fn current_url(&self) -> Answer<String> {
        let address = self.get("url").await?;
        Ok(address.as_str().expect("an address").to_owned())
    }

    pub async fn execute(&self, script: &str, arguments: Value) -> Answer<Value> {
        let content = json!({ "script": script, "args": arguments });
        self.post("execute/sync", content).await
    }

    pub async fn execute_async(&self, script: &str) -> Answer<Value> {
        let content = json!({ "script": script, "args": [] });
        self.post("execute/async", content).await
    }

    /// Finds an element by a CSS selector.
    pub async fn find(&self, selector: &str) -> Answer<WebElement> {
        let content = json!({ "using": "css selector", "value": selector });
        let element = self.post("element", content).await?;
        Ok(WebElement {
            driver: self.clone(),
            element,
        })
    }

    pub async fn window(&self) -> Answer<WindowHandle> {
        self.get("window").await.map(WindowHandle)
    }

    pub async fn new_tab(&self) -> Answer<WindowHandle> {
        let tab = self.post("window/new", json!({ "type": "tab" })).await?;
        Ok(WindowHandle(tab["handle"].clone()))
    }

    pub async fn switch_to_window(&self, window: WindowHandle) -> Answer<()> {
        let content = json!({ "handle": window.0 });
        self.post("window", content).await.map(drop)
    }

    /// Closes the current tab; the caller has to switch to another one.
    pub async fn close_window(&self) -> Answer<()> {
        let path = format!("/session/{}/window", self.session);
        command(self.port, "DELETE", &path, None).await.map(drop)
    }

    /// Sends a command of the DevTools protocol of Chromium.
    pub async fn chromium(&self, name: &str, parameters: Value) -> Answer<Value> {
        let content = json!({ "cmd": name, "params": parameters });
        self.post("goog/cdp/execute", content).await
    }

    pub async fn screenshot(&self, path: &Path) -> Answer<()> {
        let screenshot = self.get("screenshot").await?;
        let picture = from_base64(screenshot.as_str().expect("a picture"));
        std::fs::write(path, picture).map_err(|error| Refused(format!("{path:?}: {error}")))
    }

    /// Ends the browser. It blocks, so that it can be called where a page is dropped.
    pub fn quit(&self) -> std::io::Result<()> {
        let mut stream = std::net::TcpStream::connect(("127.0.0.1", self.port))?;
        let path = format!("/session/{}", self.session);
        write!(
            stream,
            "DELETE {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 0\r\n\r\n"
        )?;
        stream.read(&mut [0; 64]).map(drop)
    }
}

pub struct WebElement {
    driver: WebDriver,
    element: Value,
}

impl WebElement {
    async fn post(&self, what: &str, content: Value) -> Answer<()> {
        let id = self.element[ELEMENT].as_str().expect("an element");
        let what = format!("element/{id}/{what}");
        self.driver.post(&what, content).await.map(drop)
    }

    pub async fn click(&self) -> Answer<()> {
        self.post("click", json!({})).await
    }

    pub async fn send_keys(&self, text: impl AsRef<str>) -> Answer<()> {
        self.post("value", json!({ "text": text.as_ref() })).await
    }

    pub async fn focus(&self) -> Answer<()> {
        let arguments = json!([self.element]);
        let focused = self.driver.execute("arguments[0].focus()", arguments);
        focused.await.map(drop)
    }
}

/// A sequence of actions with mouse and keyboard.
pub struct Actions {
    driver: WebDriver,
    /// Duration of a move.
    frame: Duration,
    mouse: Vec<Value>,
    keyboard: Vec<Value>,
}

impl Actions {
    pub fn new(driver: &WebDriver, frame: Duration) -> Self {
        Actions {
            driver: driver.clone(),
            frame,
            mouse: Vec::new(),
            keyboard: Vec::new(),
        }
    }

    /// Adds an action of the mouse, during which the keyboard pauses.
    fn with_mouse(mut self, action: Value) -> Self {
        self.mouse.push(action);
        self.keyboard.push(json!({ "type": "pause" }));
        self
    }

    fn with_key(mut self, kind: &str, key: char) -> Self {
        self.keyboard.push(json!({ "type": kind, "value": key }));
        self.mouse.push(json!({ "type": "pause" }));
        self
    }

    fn moved(self, origin: Value, x: i64, y: i64) -> Self {
        let duration = self.frame.as_millis();
        let to = json!({ "type": "pointerMove", "duration": duration, "origin": origin, "x": x, "y": y });
        self.with_mouse(to)
    }

    pub fn move_to(self, x: i64, y: i64) -> Self {
        self.moved(json!("viewport"), x, y)
    }

    pub fn move_by_offset(self, x: i64, y: i64) -> Self {
        self.moved(json!("pointer"), x, y)
    }

    pub fn move_to_element_center(self, element: &WebElement) -> Self {
        self.moved(element.element.clone(), 0, 0)
    }

    pub fn click_and_hold(self) -> Self {
        self.with_mouse(json!({ "type": "pointerDown", "button": 0 }))
    }

    pub fn release(self) -> Self {
        self.with_mouse(json!({ "type": "pointerUp", "button": 0 }))
    }

    pub fn double_click_element(self, element: &WebElement) -> Self {
        let there = self.move_to_element_center(element);
        there.click_and_hold().release().click_and_hold().release()
    }

    pub fn key_down(self, key: Key) -> Self {
        self.with_key("keyDown", key.character())
    }

    pub fn key_up(self, key: Key) -> Self {
        self.with_key("keyUp", key.character())
    }

    pub fn send_keys(self, text: impl AsRef<str>) -> Self {
        let press = |hand: Self, key| hand.with_key("keyDown", key).with_key("keyUp", key);
        text.as_ref().chars().fold(self, press)
    }

    pub async fn perform(self) -> Answer<()> {
        let actions = json!({ "actions": [
            { "type": "pointer", "id": "mouse", "parameters": { "pointerType": "mouse" }, "actions": self.mouse },
            { "type": "key", "id": "keyboard", "actions": self.keyboard } ] });
        self.driver.post("actions", actions).await.map(drop)
    }
}

/// Sends a command and waits for its value.
async fn command(port: u16, method: &str, path: &str, content: Option<&Value>) -> Answer<Value> {
    let content = content.map(Value::to_string).unwrap_or_default();
    let said = format!(
        "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\
         Content-Type: application/json; charset=utf-8\r\nContent-Length: {}\r\n\r\n{content}",
        content.len()
    );
    let heard = tokio::time::timeout(LIMIT, exchange(port, said.as_bytes()))
        .await
        .map_err(|_| Refused(format!("no answer to {method} {path} {content}")))?
        .map_err(|error| Refused(format!("{method} {path} {content}: {error}")))?;
    let answer: Value = serde_json::from_slice(&heard)
        .map_err(|error| Refused(format!("{method} {path} {content}: {error}")))?;
    match &answer["value"]["error"] {
        Value::String(error) => Err(Refused(format!(
            "{error}: {}",
            answer["value"]["message"].as_str().unwrap_or_default()
        ))),
        _ => Ok(answer["value"].clone()),
    }
}

/// Sends a request, and reads the body of the answer.
async fn exchange(port: u16, mut said: &[u8]) -> std::io::Result<Vec<u8>> {
    let stream = TcpStream::connect(("127.0.0.1", port)).await?;
    while !said.is_empty() {
        stream.writable().await?;
        match stream.try_write(said) {
            Ok(count) => said = &said[count..],
            Err(error) if error.kind() == ErrorKind::WouldBlock => {}
            Err(error) => return Err(error),
        }
    }
    let mut heard = Vec::new();
    let mut part = [0; 1 << 16];
    loop {
        stream.readable().await?;
        match stream.try_read(&mut part) {
            Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
            Ok(count) => heard.extend_from_slice(&part[..count]),
            Err(error) if error.kind() == ErrorKind::WouldBlock => {}
            Err(error) => return Err(error),
        }
        if let Some(content) = whole_content(&heard) {
            return Ok(content.to_vec());
        }
    }
}

/// Returns the body of an answer once it has the length that the head announces.
fn whole_content(heard: &[u8]) -> Option<&[u8]> {
    let end = heard.windows(4).position(|four| four == b"\r\n\r\n")?;
    let head = std::str::from_utf8(&heard[..end]).expect("a head is text");
    let length = head.lines().find_map(|line| {
        let (name, value) = line.split_once(':')?;
        name.eq_ignore_ascii_case("content-length")
            .then(|| value.trim().parse().expect("a length"))
    });
    heard[end + 4..].get(..length.expect("the length of the content"))
}

fn from_base64(text: &str) -> Vec<u8> {
    let digit = |c: u8| match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let digits: Vec<u8> = text.bytes().filter(|c| *c != b'=').map(digit).collect();
    let mut bytes = Vec::with_capacity(digits.len() * 3 / 4);
    for four in digits.chunks(4) {
        let digits = four
            .iter()
            .fold(0_u32, |bits, digit| bits << 6 | u32::from(*digit));
        let bits = digits << (6 * (4 - four.len()));
        bytes.extend_from_slice(&bits.to_be_bytes()[1..four.len()]);
    }
    bytes
}
