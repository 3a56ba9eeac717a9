//! Goal: the server of `sawflutter explore` answers its own page with the results of the library, refuses every other
//! client, and limits its work.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use sawflutter::analyses::campbell::Report;
use sawflutter::model::scene::{Accuracy, Freed, MAX_SCENE_BYTES, RefusedValue, Scene, SceneError};
use sawflutter::stability::{Analysis, AnalysisOptions, Detail};
use serde_json::{Value, json};
use tempfile::TempDir;

use super::program::{PATIENCE, program, run, text, write_scene};

struct Server {
    child: Child,
    host: String,
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

struct Answer {
    status: u16,
    head: String,
    body: Vec<u8>,
}

impl Answer {
    fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap()
    }

    /// The last line of an answer that comes line by line, in chunks.
    fn last_line(&self) -> Value {
        let body = String::from_utf8(self.body.clone()).unwrap();
        let mut lines = body.lines().filter(|line| line.starts_with('{'));
        serde_json::from_str(lines.next_back().unwrap()).unwrap()
    }
}

impl Server {
    fn start() -> Self {
        let mut command = Command::new(program());
        let mut child = command
            .arg("explore")
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap())
            .read_line(&mut line)
            .unwrap();
        let host = line
            .trim()
            .strip_prefix("http://")
            .and_then(|l| l.strip_suffix('/'))
            .unwrap_or_else(|| panic!("no address: {line}"))
            .to_owned();
        Server { child, host }
    }

    fn send(&self, line: &str, headers: &[(&str, &str)], body: &str) -> TcpStream {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let mut head = format!("{line} HTTP/1.1\r\nConnection: close\r\n");
        if headers.iter().all(|(name, _)| *name != "Host") {
            head += &format!("Host: {}\r\n", self.host);
        }
        for (name, value) in headers {
            head += &format!("{name}: {value}\r\n");
        }
        head += &format!("Content-Length: {}\r\n\r\n", body.len());
        stream.write_all(head.as_bytes()).unwrap();
        // A server that refuses a body does not read it.
        let _ = stream.write_all(body.as_bytes());
        stream
    }

    fn ask(&self, line: &str, headers: &[(&str, &str)], body: &str) -> Answer {
        let mut answer = Vec::new();
        let _ = self.send(line, headers, body).read_to_end(&mut answer);
        let end = answer
            .windows(4)
            .position(|w| w == b"\r\n\r\n")
            .unwrap_or_else(|| {
                panic!("{line}: {}", String::from_utf8_lossy(&answer));
            });
        let head = String::from_utf8(answer[..end].to_vec()).unwrap();
        Answer {
            status: head.split(' ').nth(1).unwrap().parse().unwrap(),
            head: head.to_lowercase(),
            body: answer[end + 4..].to_vec(),
        }
    }
}

fn paper() -> String {
    serde_json::to_string(Scene::paper().file()).unwrap()
}

#[test]
fn a_draft_is_the_librarys_draft_and_modes_can_be_asked_for() {
    let server = Server::start();
    let answer = server.ask("POST /chart/draft", &[], &paper());
    assert_eq!(answer.status, 200);
    let mut found = answer.last_line();
    let paper_saw = Scene::paper();
    let scene = paper_saw
        .edited(|saw| (saw.accuracy, saw.tolerance) = (Accuracy::Draft, Some(2e-2)))
        .unwrap();
    let sketch = AnalysisOptions {
        detail: Detail::Sketch,
        ..AnalysisOptions::default()
    };
    let analysis = Analysis::with_options(&scene, sketch).unwrap();
    let report: Report = serde_json::from_value(found["report"].take()).unwrap();
    let whole = analysis.report();
    assert_eq!(report.critical_speeds, whole.critical_speeds);
    assert_eq!(report.instabilities, whole.instabilities);
    assert_eq!(report.operating, whole.operating);
    assert_eq!(report.accuracy, whole.accuracy);
    assert_eq!(report.certificate.krein_violations, 0);

    // The page gets the description of its chart, and not the points of its branches.
    let branch = &whole.campbell.branches[2];
    let (rpm, hz) = (branch.rpm[10], branch.frequency_hz[10]);
    let asked = format!(
        r#"{{ "chart": {}, "rpm": {rpm}, "frequency_hz": {hz} }}"#,
        found["chart"]
    );
    let mode = server.ask("POST /mode", &[], &asked).json();
    assert_eq!(mode["frequency_hz"], hz);
    assert_eq!(mode["body_frequency_hz"], branch.body_frequency_hz[10]);
    assert_eq!(mode["krein_sign"], branch.krein_sign[10]);
    let strongest = &mode["harmonics"][0];
    assert_eq!(
        strongest["nodal_diameters"],
        branch.dominant_harmonics[10][0]
    );
    assert_eq!(strongest["cosine"]["re"].as_array().unwrap().len(), 41);

    let gone = server.ask(
        "POST /mode",
        &[],
        r#"{ "chart": 99, "rpm": 0, "frequency_hz": 1 }"#,
    );
    assert_eq!(gone.status, 422);
}

#[test]
fn requests_of_other_pages_are_refused() {
    let server = Server::start();
    assert_eq!(server.ask("GET /", &[], "").status, 200);
    let own = format!("http://{}", server.host);
    assert_eq!(
        server.ask("GET /start", &[("Origin", &own)], "").status,
        200
    );
    for stranger in [
        ("Host", "sawflutter.example"),
        ("Host", "127.0.0.1"),
        ("Origin", "http://sawflutter.example"),
        ("Origin", "null"),
    ] {
        for line in [
            "GET /",
            "GET /start",
            "POST /chart/draft",
            "POST /save/scene.json",
        ] {
            let answer = server.ask(line, &[stranger], &paper());
            assert_eq!(answer.status, 403, "{line} of {stranger:?}");
        }
    }
    let head = server.ask("GET /", &[], "").head;
    assert!(
        head.contains("content-security-policy: default-src 'none'"),
        "{head}"
    );
    assert!(!head.contains("access-control-allow-origin"), "{head}");
}

#[test]
fn bad_and_boundless_requests_are_refused() {
    let server = Server::start();
    let huge = " ".repeat(MAX_SCENE_BYTES as usize + 1);
    assert_eq!(server.ask("POST /chart/draft", &[], &huge).status, 413);
    let negative = paper().replace("0.0028", "-0.0028");
    let refusal = server.ask("POST /chart/scene", &[], &negative).last_line();
    assert_eq!(refusal["refusal"]["key"], "blade.thickness_m");
    let words = Scene::from_json(&negative).unwrap_err().to_string();
    assert_eq!(refusal["refusal"]["message"], words);
    // No blade survives 3e6 rpm, and no basis represents the waves of such a sweep.
    let endless = paper().replace("\"to_rpm\":3000.0", "\"to_rpm\":3000000.0");
    assert_ne!(endless, paper());
    let too_fast = server.ask("POST /chart/draft", &[], &endless).last_line();
    assert_eq!(too_fast["refusal"]["key"], "sweep.to_rpm");
    for (line, status) in [
        ("GET /../Cargo.toml", 404),
        ("GET /page/../../Cargo.toml", 404),
        ("POST /save/passwd", 404),
        ("POST /chart/exact", 400),
        ("POST /task/passwd", 400),
        ("GET /chart/draft", 405),
    ] {
        assert_eq!(server.ask(line, &[], &paper()).status, status, "{line}");
    }
}

/// A browser that closes its request cancels the computation, which then delays no other request, and is counted as
/// stopped when it ends.
#[test]
fn a_cancelled_request_is_stopped() {
    let server = Server::start();
    let reference = paper().replacen('{', r#"{"tolerance":1e-5,"#, 1);
    let taken_back = server.send("POST /chart/scene", &[], &reference);
    std::thread::sleep(Duration::from_millis(100));
    drop(taken_back);
    assert_eq!(server.ask("POST /chart/draft", &[], &paper()).status, 200);
    let both_ended = serde_json::json!({ "finished": 1, "stopped": 1 });
    let begun = Instant::now();
    loop {
        let jobs = server.ask("GET /jobs", &[], "").json();
        if jobs == both_ended {
            break;
        }
        assert!(begun.elapsed() < Duration::from_secs(20), "{jobs}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Ctrl-C ends the program at once, whatever it computes.
#[cfg(unix)]
#[test]
fn an_interrupt_ends_the_program() {
    let mut server = Server::start();
    let reference = paper().replacen('{', r#"{"tolerance":1e-5,"#, 1);
    let _waiting = server.send("POST /chart/scene", &[], &reference);
    std::thread::sleep(Duration::from_millis(100));
    let id = server.child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status().unwrap();
    assert!(sent.success());
    let begun = Instant::now();
    let status = loop {
        if let Some(status) = server.child.try_wait().unwrap() {
            break status;
        }
        assert!(begun.elapsed() < Duration::from_secs(30), "it goes on");
        std::thread::sleep(Duration::from_millis(20));
    };
    assert!(status.success(), "{status}");
}

/// The library alone words the error of a missing block: the page answers with its text and its key, and the program
/// prints its text.
#[test]
fn page_and_program_word_a_missing_block_equally() {
    let saw = Scene::paper()
        .edited(|saw| {
            saw.cut = None;
            saw.runup = None;
            saw.measured = None;
            saw.operating_rpm = None;
            saw.guides.clear();
        })
        .unwrap();
    let folder = TempDir::new().unwrap();
    let path = write_scene(&folder, saw.file());
    let cases: [(&str, &[&str], RefusedValue); 6] = [
        ("cut", &[], saw.needed_cut().unwrap_err()),
        ("runup", &[], saw.needed_runup().unwrap_err()),
        ("washboard", &[], saw.needed_washboarding().unwrap_err()),
        ("fit", &[], saw.needed_measured().unwrap_err()),
        (
            "place",
            &["--goal", "window"],
            saw.needed_operating_rpm(None).unwrap_err(),
        ),
        ("place", &[], no_guides()),
    ];
    let server = Server::start();
    for (command, options, expected) in cases {
        let asked =
            json!({ "scene": saw.file(), "options": { "goal": options.last().unwrap_or(&"") } });
        let answer = server.ask(&format!("POST /task/{command}"), &[], &asked.to_string());
        let refusal = &answer.last_line()["refusal"];
        assert_eq!(refusal["key"], expected.key, "{command}");
        assert_eq!(refusal["message"], expected.to_string(), "{command}");
        let arguments = [&[command, path.to_str().unwrap()], options].concat();
        let output = run(&arguments, &folder);
        assert_eq!(output.status.code(), Some(2), "{command}");
        let said = text(&output.stderr).replace('\n', " ");
        assert!(said.contains(&expected.to_string()), "{command}: {said}");
    }
}

fn no_guides() -> RefusedValue {
    let free = Scene::paper().edited(|saw| saw.guides.clear());
    match Freed::to_place(&free.unwrap(), &[]) {
        Err(SceneError::Value(refused)) => refused,
        other => panic!("{other:?}"),
    }
}
