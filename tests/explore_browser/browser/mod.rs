//! A page of `sawflutter explore` in Chromium, and simulated input of its user.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use program::program;
pub use webdriver::{Actions, Key, WebDriver, WebElement, WindowHandle};

#[path = "../../common/program.rs"]
mod program;
mod webdriver;

/// Selector of the first pad.
pub const PAD: &str = "[data-path='guides[0]'] .body";
/// Time limit that is longer than any step takes, also on a busy machine.
pub const PATIENCE: Duration = Duration::from_secs(180);

/// A program that is ended when this value is dropped.
pub struct Running(pub Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Starts a program and waits for a line in which `find` has a result.
fn start(command: &mut Command, find: impl Fn(&str) -> Option<String>) -> (Running, String) {
    let mut child = command
        .stdout(Stdio::piped())
        .spawn()
        .unwrap_or_else(|error| {
            panic!("{command:?}: {error}; apt-get install chromium chromium-driver")
        });
    let output = child.stdout.take().unwrap();
    let running = Running(child);
    let mut lines = BufReader::new(output).lines().map_while(Result::ok);
    let found = lines
        .find_map(|line| find(&line))
        .expect("the program said nothing");
    // The rest is read and dropped, because a full pipe would stop the program.
    std::thread::spawn(move || lines.for_each(drop));
    (running, found)
}

/// Starts `sawflutter explore` and waits until it prints its address.
fn explore(arguments: &[&str]) -> (Running, String) {
    let command = &mut Command::new(program());
    start(command.arg("explore").args(arguments), |line| {
        line.starts_with("http://127.0.0.1:")
            .then(|| line.to_owned())
    })
}

/// The page, the program that serves it, and the browser.
pub struct Page {
    pub driver: WebDriver,
    folder: tempfile::TempDir,
    pub program: Running,
    _chromedriver: Running,
}

impl Drop for Page {
    /// Closes the browser, also after a failure: without its driver it would go on.
    fn drop(&mut self) {
        let _ = self.driver.quit();
    }
}

/// Serves the files of a folder, and nothing else.
fn served(folder: &Path) -> (Running, String) {
    assert!(
        folder.join("index.html").exists(),
        "{} is not there; web/build makes it",
        folder.display()
    );
    let command = &mut Command::new("python3");
    let server = ["-u", "-m", "http.server", "0", "--bind", "127.0.0.1"];
    let command = command.args(server).arg("--directory").arg(folder);
    start(command, |line| {
        let (_, address) = line.split_once("(http://")?;
        Some(format!("http://{}", address.split_once(')')?.0))
    })
}

impl Page {
    /// Opens the page, without the cards of a first visit.
    pub async fn open(arguments: &[&str]) -> Self {
        let page = Self::open_first(arguments).await;
        page.script("document.querySelector('#welcome .card')?.click()")
            .await;
        page
    }

    /// Opens a saw of the folder of scenes at draft accuracy, and waits for its chart.
    pub async fn drafted(name: &str) -> Self {
        let scene = format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let page = Self::open(&[&scene, "--accuracy", "draft"]).await;
        page.settle().await;
        page
    }

    /// Opens the page as at a first visit.
    pub async fn open_first(arguments: &[&str]) -> Self {
        Self::at(explore(arguments)).await
    }

    /// Opens the page in a folder, which is served without the program.
    pub async fn open_folder(folder: &Path) -> Self {
        Self::at(served(folder)).await
    }

    async fn at((program, address): (Running, String)) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let (chromedriver, port) = start(Command::new("chromedriver").arg("--port=0"), |line| {
            let (_, port) = line.split_once("started successfully on port ")?;
            Some(port.trim_end_matches('.').to_owned())
        });
        let profile = format!(
            "--user-data-dir={}",
            folder.path().join("profile").display()
        );
        let flags = [
            "--headless=new",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            // Without a graphics processor WebGL2 is computed; Chromium 137 and later do that only if asked.
            "--enable-unsafe-swiftshader",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--window-size=1280,900",
            "--hide-scrollbars",
            &profile,
        ];
        let downloads = json!({ "download.default_directory": folder.path(), "download.prompt_for_download": false });
        let options = json!({ "args": flags, "prefs": downloads });
        let driver = WebDriver::new(port.parse().unwrap(), options)
            .await
            .unwrap_or_else(|error| panic!("{error}"));
        driver.goto(&address).await.unwrap();
        let page = Page {
            driver,
            folder,
            program,
            _chromedriver: chromedriver,
        };
        page.wait("window.sawflutter?.computed.length > 0").await;
        page
    }

    /// Opens the page in another tab and switches to it.
    pub async fn another_tab(&self) -> WindowHandle {
        let address = self.driver.current_url().await.unwrap();
        let tab = self.driver.new_tab().await.unwrap();
        self.driver.switch_to_window(tab.clone()).await.unwrap();
        self.driver.goto(address.as_str()).await.unwrap();
        tab
    }

    /// Starts the program once more, at the address that the page uses.
    pub async fn start_again(&mut self, arguments: &[&str]) {
        let address = self.driver.current_url().await.unwrap();
        let (_, port) = address.trim_end_matches('/').rsplit_once(':').unwrap();
        (self.program, _) = explore(&[arguments, &["--port", port]].concat());
    }

    pub async fn script(&self, script: &str) -> Value {
        let found = self.driver.execute(script, json!([])).await;
        found.unwrap_or_else(|error| panic!("{script}: {error}"))
    }

    pub async fn value(&self, expression: &str) -> Value {
        self.script(&format!("return {expression}")).await
    }

    /// Returns the value of an asynchronous script: an expression with `await`.
    pub async fn awaited(&self, expression: &str) -> Value {
        let script = format!(
            "const done = arguments[arguments.length - 1]; (async () => {expression})().then(done)"
        );
        let found = self.driver.execute_async(&script).await;
        found.unwrap_or_else(|error| panic!("{expression}: {error}"))
    }

    pub async fn text(&self, selector: &str) -> String {
        let found = self
            .value(&format!("document.querySelector({selector:?}).textContent"))
            .await;
        found.as_str().unwrap().to_owned()
    }

    pub async fn wait(&self, condition: &str) {
        let begun = Instant::now();
        while self.value(condition).await != Value::Bool(true) {
            assert!(begun.elapsed() < PATIENCE, "{condition} did not come true");
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }

    /// Waits until the chart is that of the scene at the accuracy of the scene.
    pub async fn settle(&self) {
        self.wait("sawflutter.settled()").await;
    }

    pub async fn find(&self, selector: &str) -> WebElement {
        self.driver.find(selector).await.unwrap()
    }

    /// Types a text into a field in place of its present text.
    pub async fn enter(&self, path: &str, text: &str) {
        self.script(&format!("sawflutter.reveal({path:?})")).await;
        let field = self.find(&format!("[id={path:?}]")).await;
        field.send_keys(Key::Control + "a").await.unwrap();
        field.send_keys(text).await.unwrap();
        field.send_keys(Key::Tab + "").await.unwrap();
    }

    /// Opens an example by its number in the list.
    pub async fn open_example(&self, number: usize) {
        let card = format!("document.querySelectorAll('#examples .card')[{number}].click()");
        self.script(&card).await;
    }

    /// Opens the tab that has a task.
    pub async fn open_tab_of(&self, task: &str) {
        let tab = format!(
            "document.querySelector('#tab-' + document.querySelector('#panel-{task}').parentElement.id.replace('group-', '')).click()"
        );
        self.script(&tab).await;
    }

    /// Selects a mode of the chart by key, which shows that the program still has the chart.
    pub async fn step_to_a_mode(&self) {
        let chart = self.find("#campbell").await;
        chart.focus().await.unwrap();
        chart.send_keys(Key::Right + "").await.unwrap();
        self.wait("document.querySelector('#mode').textContent.includes('Krein')")
            .await;
    }

    pub async fn screenshot(&self, name: &str) {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("../explore-screenshots");
        std::fs::create_dir_all(&folder).unwrap();
        self.driver.screenshot(&folder.join(name)).await.unwrap();
    }

    /// Clicks a button that saves a file, and reads the saved file.
    pub async fn download(&self, name: &str) -> Vec<u8> {
        let file = self.file_name(name).await;
        // A file that was saved before would be read instead of the new one.
        let _ = std::fs::remove_file(self.folder.path().join(file));
        self.script("document.querySelector('.menu').open = true")
            .await;
        // The click is a real one, because the browser asks before a script saves a second file.
        self.find(&format!("[data-save={name:?}]"))
            .await
            .click()
            .await
            .unwrap();
        self.wait_for_file(name).await
    }

    /// Returns the name under which a file of this saw is saved.
    async fn file_name(&self, name: &str) -> String {
        let file = self.value(&format!("sawflutter.nameOf({name:?})")).await;
        file.as_str().unwrap().to_owned()
    }

    /// Waits for a file that the browser saves for this saw, and reads it. Chromium first makes an empty file of this
    /// name, and then replaces it by the complete one.
    pub async fn wait_for_file(&self, name: &str) -> Vec<u8> {
        let path = self.folder.path().join(self.file_name(name).await);
        let begun = Instant::now();
        loop {
            let content = std::fs::read(&path).unwrap_or_default();
            if !content.is_empty() {
                return content;
            }
            assert!(begun.elapsed() < PATIENCE, "{name} was not saved");
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }

    /// Runs `analyze` on the saved scene and returns its folder.
    pub async fn command_line(&self) -> PathBuf {
        self.command(&["analyze"]).await.0
    }

    /// Runs a command on the saved scene; returns its folder and its output.
    pub async fn command(&self, command: &[&str]) -> (PathBuf, String) {
        let scene = self.download("scene.json").await;
        let path = self.folder.path().join("saved-scene.json");
        std::fs::write(&path, scene).unwrap();
        let out = self.folder.path().join("out");
        let done = Command::new(program())
            .args(command)
            .args([path.as_os_str(), "--out".as_ref(), out.as_os_str()])
            .output()
            .unwrap();
        assert!(
            done.status.success(),
            "{}",
            String::from_utf8_lossy(&done.stderr)
        );
        (out, String::from_utf8(done.stdout).unwrap())
    }

    pub async fn close(self) {
        drop(self);
    }
}

pub fn run(test: impl Future<Output = ()>) {
    let mut builder = tokio::runtime::Builder::new_current_thread();
    builder.enable_all().build().unwrap().block_on(test);
}

/// Creates actions whose pointer moves take a sixtieth of a second each, the period of a screen.
pub fn hand(page: &Page) -> Actions {
    let frame = Duration::from_millis(16);
    Actions::new(&page.driver, frame)
}

/// Presses the button on an element, moves in small steps, and releases the button.
pub async fn drag(page: &Page, selector: &str, steps: usize, step: (i64, i64)) {
    let grip = page.find(selector).await;
    let grasp = hand(page);
    grasp
        .move_to_element_center(&grip)
        .click_and_hold()
        .perform()
        .await
        .unwrap();
    for _ in 0..steps {
        let moved = hand(page).move_by_offset(step.0, step.1);
        moved.perform().await.unwrap();
    }
}

pub async fn let_go(page: &Page) {
    hand(page).release().perform().await.unwrap();
}

pub fn percentile(times: &Value, share: f64) -> f64 {
    let mut times: Vec<f64> = times
        .as_array()
        .unwrap()
        .iter()
        .filter_map(Value::as_f64)
        .collect();
    times.sort_by(f64::total_cmp);
    times[((times.len() - 1) as f64 * share).round() as usize]
}

/// Compares numbers to the last bit. 1.0 and 1 are equal, because JavaScript writes the former as the latter.
pub fn same(left: &Value, right: &Value) -> bool {
    match (left, right) {
        (Value::Number(x), Value::Number(y)) => x.as_f64() == y.as_f64(),
        (Value::Array(x), Value::Array(y)) => {
            x.len() == y.len() && x.iter().zip(y).all(|(x, y)| same(x, y))
        }
        (Value::Object(x), Value::Object(y)) => {
            x.len() == y.len()
                && x.iter()
                    .all(|(key, x)| y.get(key).is_some_and(|y| same(x, y)))
        }
        _ => left == right,
    }
}
