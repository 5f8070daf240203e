//! The page on a file, and live sheets, with a stand-in for the built page.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Stdio};
use std::time::Duration;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::read::DeflateDecoder;
use serde_json::Value;

use super::folder::Folder;

const CRANK: &str = "
    /// </script><script>alert(1)</script>
    mechanism Crank { param r = 2; input phi; unknown x, y; loop r@phi = (x, y); point P = r@phi; }";

/// A folder with a mechanism and a page that has what the program changes in it.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("crank.linkage", CRANK);
    std::fs::create_dir(folder.path("dist")).unwrap();
    folder.write("dist/linkage.html", "<html><head>\n<meta content=\"connect-src 'none'\"></head></html>");
    folder.write("dist/live-head.html", "<meta name=\"policy\">\n");
    folder
        .write("dist/live-body.html", "<script type=\"application/json\" id=\"linkage-data\">LINKAGE_DATA</script>\n");
    folder
}

/// The program while it serves a file.
struct Served {
    child: Child,
    port: u16,
}

impl Served {
    fn of(folder: &Folder) -> Self {
        let mut command = folder.command("serve crank.linkage --page dist");
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
        let port = line.trim().trim_end_matches('/').rsplit(':').next().unwrap().parse().unwrap();
        Self { child, port }
    }

    /// A connection on which these bytes are sent.
    fn begin(&self, bytes: &str) -> TcpStream {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        stream.write_all(bytes.replace("PORT", &self.port.to_string()).as_bytes()).unwrap();
        stream
    }

    /// The status, the head and the body of an answer.
    fn ask(&self, request: &str) -> (u16, String, String) {
        let request = request.replace('\n', "\r\n");
        Self::answer(self.begin(&format!("{request}\r\nConnection: close\r\n\r\n")))
    }

    fn answer(mut stream: TcpStream) -> (u16, String, String) {
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        let status = head.split(' ').nth(1).unwrap().parse().unwrap();
        (status, head.to_owned(), body.to_owned())
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn a_page_follows_its_file_and_gives_nothing_else() {
    let folder = folder();
    let served = Served::of(&folder);
    let (status, head, page) = served.ask("GET / HTTP/1.1\nHost: 127.0.0.1:PORT");
    assert_eq!(status, 200);
    assert!(head.contains("Cross-Origin-Resource-Policy: same-origin"), "{head}");
    assert!(page.contains("<meta name=\"linkage-file\" content=\"crank.linkage\">"), "{page}");
    assert!(page.contains("connect-src 'self'"), "{page}");

    let (status, head, text) = served.ask("GET /text HTTP/1.1\nHost: localhost:PORT");
    assert_eq!((status, text.as_str()), (200, CRANK));
    let tag = head.lines().find_map(|line| line.strip_prefix("ETag: ")).unwrap();
    let again = format!("GET /text HTTP/1.1\nHost: localhost:PORT\nIf-None-Match: {tag}");
    assert_eq!(served.ask(&again).0, 304);
    folder.write("crank.linkage", "mechanism Other { input phi; }");
    let (status, _, text) = served.ask(&again);
    assert_eq!((status, text.as_str()), (200, "mechanism Other { input phi; }"));

    for (request, expected) in [
        ("GET /text HTTP/1.1\nHost: example.org:PORT", 403),
        ("GET /text HTTP/1.1\nHost: 127.0.0.1", 403),
        ("GET /crank.linkage HTTP/1.1\nHost: 127.0.0.1:PORT", 404),
        ("GET /../crank.linkage HTTP/1.1\nHost: 127.0.0.1:PORT", 404),
        ("GET /%2e%2e/%2e%2e/etc/passwd HTTP/1.1\nHost: 127.0.0.1:PORT", 404),
        ("DELETE /text HTTP/1.1\nHost: 127.0.0.1:PORT", 405),
    ] {
        let (status, _, body) = served.ask(request);
        assert_eq!(status, expected, "{request}: {body}");
    }
    std::fs::remove_file(folder.path("crank.linkage")).unwrap();
    let (status, _, why) = served.ask("GET /text HTTP/1.1\nHost: 127.0.0.1:PORT");
    assert_eq!(status, 404);
    assert!(why.contains("there is no such file"), "{why}");
}

/// Clients that send nothing, half, too much, or a body: each is answered or closed, and the page and its text are answered
/// meanwhile.
#[test]
fn a_server_outlives_strangers() {
    let folder = folder();
    let served = Served::of(&folder);
    let still_answers = |after: &str| {
        let (status, _, text) = served.ask("GET /text HTTP/1.1\nHost: 127.0.0.1:PORT");
        assert_eq!((status, text.as_str()), (200, CRANK), "after {after}");
    };
    let host = "Host: 127.0.0.1:PORT\r\n";
    let long = format!("X: {}\r\n\r\n", "a".repeat(9000));
    let many = "X: a\r\n".repeat(80) + "\r\n";
    for (of, head, expected) in [
        ("a body of 100 GB", format!("POST /text HTTP/1.1\r\n{host}Content-Length: 99999999999\r\n\r\n"), 413),
        ("a foreign body", "GET / HTTP/1.1\r\nHost: a.org\r\nContent-Length: 99999999999\r\n\r\n".to_owned(), 413),
        ("a length that is none", format!("GET /text HTTP/1.1\r\n{host}Content-Length: -1\r\n\r\n"), 413),
        ("a body that does not come", format!("GET /text HTTP/1.1\r\n{host}Content-Length: 5\r\n\r\n"), 413),
        ("an expectation", format!("GET / HTTP/1.1\r\n{host}Expect: 100-continue\r\nContent-Length: 5\r\n\r\n"), 413),
        ("chunks", format!("POST / HTTP/1.1\r\n{host}Transfer-Encoding: chunked\r\n\r\nFFFFFFFFFFFFFFFF\r\n"), 413),
        ("a long head", format!("GET / HTTP/1.1\r\n{host}{long}"), 431),
        ("many fields", format!("GET / HTTP/1.1\r\n{host}{many}"), 431),
        ("a long line", format!("GET /{} HTTP/1.1\r\n{host}\r\n", "a".repeat(9000)), 431),
        ("no request", "\u{1}\u{2}\u{3}\r\n\r\n".to_owned(), 400),
        ("another version", "GET / HTTP/3.0\r\n\r\n".to_owned(), 400),
        ("no host", "GET / HTTP/1.1\r\n\r\n".to_owned(), 403),
        ("the head alone", format!("HEAD /text HTTP/1.1\r\n{host}\r\n"), 200),
        ("an empty body", format!("GET /text HTTP/1.1\r\n{host}Content-Length: 0\r\n\r\n"), 200),
    ] {
        let (status, head, body) = Served::answer(served.begin(&head));
        assert_eq!(status, expected, "{of}: {body}");
        assert!(head.contains("X-Content-Type-Options: nosniff") && head.contains("Connection: close"), "{of}: {head}");
        assert_eq!(of == "the head alone", body.is_empty(), "{of}: {body}");
        still_answers(of);
    }
    let half = format!("GET /text HTTP/1.1\r\n{host}");
    let first = served.begin(&half);
    still_answers("half a head");
    let (status, ..) = Served::answer(first);
    assert_eq!(status, 408);
    let silent: Vec<TcpStream> = (0..200).map(|of| served.begin(if of % 2 == 0 { "" } else { &half })).collect();
    still_answers("200 connections");
    // A client that never reads.
    let deaf: Vec<TcpStream> = (0..40).map(|_| served.begin(&format!("GET / HTTP/1.1\r\n{host}\r\n"))).collect();
    still_answers("40 deaf clients");
    if let Ok(status) = std::fs::read_to_string(format!("/proc/{}/status", served.child.id())) {
        let number = |name: &str| -> u64 {
            let line = status.lines().find_map(|line| line.strip_prefix(name)).unwrap();
            line.trim().trim_end_matches(" kB").parse().unwrap()
        };
        println!("{} kB, {} threads", number("VmRSS:"), number("Threads:"));
        assert!(number("Threads:") < 250, "{status}");
    }
    drop((silent, deaf));
}

#[test]
fn without_a_built_page_there_is_one_message_with_the_command() {
    let folder = folder();
    for arguments in ["serve crank.linkage --page nowhere", "sheet crank.linkage --live --page nowhere"] {
        let ran = folder.run(arguments);
        assert_eq!(ran.code, Some(1), "{ran:?}");
        assert!(ran.messages.contains("npm --prefix web run build") && ran.messages.lines().count() == 1, "{ran:?}");
    }
}

#[test]
fn a_live_sheet_has_its_data_and_no_text_that_ends_them() {
    let folder = folder();
    let ran = folder.run("sheet crank.linkage --live --page dist --set r=3 --rate 2 -o -");
    let size = format!("the live sheet has {:.1} MB\n", ran.output.len() as f64 / 1e6);
    let page = ran.works(&size);
    assert!(page.contains("<meta charset=\"utf-8\">\n<meta name=\"policy\">"), "{page}");
    let (_, rest) = page.split_once("id=\"linkage-data\">").unwrap();
    let (data, _) = rest.split_once("</script>").unwrap();
    let deflated = BASE64_STANDARD.decode(data).unwrap();
    let data: Value = serde_json::from_reader(DeflateDecoder::new(&deflated[..])).unwrap();
    assert_eq!(data["parameters"]["r"], 3.0);
    assert_eq!((&data["name"], &data["rate"]), (&Value::from("Crank"), &Value::from(2.0)));
    assert_eq!(data["place"]["inputs"].as_array().unwrap().len(), 1);
    let mut session = linkage_page::Session::default();
    let question = serde_json::json!({ "do": "load", "written": data["written"] }).to_string();
    let loaded: Value = serde_json::from_str(&session.ask(&question, &mut |_| ())).unwrap();
    assert_eq!(loaded["mechanisms"][0]["name"], "Crank", "{loaded}");
    assert!(loaded["mechanisms"][0]["paragraphs"][0].as_str().unwrap().contains("</script>"), "{loaded}");
}

#[test]
fn a_live_sheet_is_a_page() {
    let folder = folder();
    folder
        .run("sheet crank.linkage --live --page dist -o crank.tex")
        .fails(2, "error: a live sheet is a page: leave out --live, or write -o NAME.html\n");
}
