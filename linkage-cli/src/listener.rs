//! Answers to a browser by HTTP/1.1 (RFC 9112), for reading: one request for each connection, without a body.
//!
//! Strangers cannot stop it. A head has at most 8 KiB and five seconds, a body is rejected unread, a connection has ten seconds in
//! all, and where there are more than 32 the oldest is closed. So those that are quick are answered whatever the others do.

use std::borrow::Cow;
use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read as _, Write as _};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

/// The most bytes and fields of a head.
const MOST_BYTES: usize = 8 * 1024;
const MOST_FIELDS: usize = 64;

/// The most connections at once.
const MOST_CONNECTIONS: usize = 32;

/// The time for a head, and that for a connection.
const FOR_HEAD: Duration = Duration::from_secs(5);
const FOR_ALL: Duration = Duration::from_secs(10);

/// The bytes that are read and thrown away after an answer: closed before, a connection with unread bytes loses the answer too
/// (RFC 9112, section 9.6).
const MOST_REST: usize = 64 * 1024;
const FOR_REST: Duration = Duration::from_millis(500);

/// Fields of all answers: other sites get nothing of them, and they are read again each time.
const OF_ALL: [(&str, &str); 5] = [
    ("Connection", "close"),
    ("Cache-Control", "no-store"),
    ("X-Content-Type-Options", "nosniff"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("X-Frame-Options", "DENY"),
];

/// The time without connections after one could not be accepted, as where no file may be opened.
const PAUSE: Duration = Duration::from_millis(50);

/// The head of a request.
pub struct Request {
    pub method: String,
    /// The path, and what follows a question mark.
    pub target: String,
    fields: Vec<(String, Vec<u8>)>,
}

impl Request {
    /// The value of a field, whose name may be in capitals or not; none if it is no text.
    pub fn field(&self, name: &str) -> Option<&str> {
        let (_, value) = self.fields.iter().find(|(field, _)| field.eq_ignore_ascii_case(name))?;
        std::str::from_utf8(value).ok()
    }

    /// True if a body follows the head, or may.
    fn has_body(&self) -> bool {
        let is_some = |name: &str| self.fields.iter().any(|(field, _)| field.eq_ignore_ascii_case(name));
        let lengths = self.fields.iter().filter(|(field, _)| field.eq_ignore_ascii_case("content-length"));
        is_some("transfer-encoding") || is_some("expect") || lengths.into_iter().any(|(_, length)| length != b"0")
    }
}

/// The answer to a request.
pub struct Answer<'a> {
    pub status: u16,
    pub fields: Vec<(&'static str, String)>,
    pub body: Cow<'a, str>,
}

impl Answer<'_> {
    /// A sentence.
    pub fn sentence(status: u16, words: &str) -> Self {
        let fields = vec![("Content-Type", "text/plain; charset=utf-8".to_owned())];
        Self { status, fields, body: Cow::Owned(words.to_owned()) }
    }

    /// The head and, unless the head alone is asked for, the body.
    fn to_bytes(&self, is_head: bool) -> Vec<u8> {
        let reason = match self.status {
            200 => "OK",
            304 => "Not Modified",
            400 => "Bad Request",
            403 => "Forbidden",
            404 => "Not Found",
            405 => "Method Not Allowed",
            408 => "Request Timeout",
            413 => "Content Too Large",
            431 => "Request Header Fields Too Large",
            _ => "",
        };
        let date = httpdate::fmt_http_date(SystemTime::now());
        let mut text = format!("HTTP/1.1 {} {reason}\r\nDate: {date}\r\n", self.status);
        if self.status != 304 {
            text += &format!("Content-Length: {}\r\n", self.body.len());
        }
        let of_all = OF_ALL.iter().copied();
        for (name, value) in self.fields.iter().map(|(name, value)| (*name, value.as_str())).chain(of_all) {
            text += &format!("{name}: {value}\r\n");
        }
        text += "\r\n";
        if !is_head && self.status != 304 {
            text += &self.body;
        }
        text.into_bytes()
    }
}

/// Answers requests without end.
pub fn listen<'a>(listener: &TcpListener, answer: impl Fn(&Request) -> Answer<'a> + Sync) {
    let open = Open::default();
    thread::scope(|scope| {
        for stream in listener.incoming() {
            let Some(stream) = stream.ok().and_then(|stream| open.add(stream).ok()) else {
                thread::sleep(PAUSE);
                continue;
            };
            let (open, answer) = (&open, &answer);
            // Without a thread there is no answer, and a client that went away needs none.
            let _ = thread::Builder::new().spawn_scoped(scope, move || {
                let _ = connected(&stream, answer);
                open.remove(&stream);
            });
        }
    });
}

/// The connections that are open, the oldest first.
#[derive(Default)]
struct Open(Mutex<VecDeque<Arc<TcpStream>>>);

impl Open {
    /// Adds a connection, and closes the oldest if there are too many.
    fn add(&self, stream: TcpStream) -> io::Result<Arc<TcpStream>> {
        stream.set_nodelay(true)?;
        let stream = Arc::new(stream);
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.push_back(Arc::clone(&stream));
        if all.len() > MOST_CONNECTIONS
            && let Some(oldest) = all.pop_front()
        {
            // Its thread then reads or writes no more.
            let _ = oldest.shutdown(Shutdown::Both);
        }
        Ok(stream)
    }

    fn remove(&self, stream: &Arc<TcpStream>) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.retain(|other| !Arc::ptr_eq(other, stream));
    }
}

/// Reads the request of a connection and answers it.
fn connected<'a>(stream: &TcpStream, answer: &(impl Fn(&Request) -> Answer<'a> + Sync)) -> io::Result<()> {
    let start = Instant::now();
    let mut is_head = false;
    let answer = match head(stream, start + FOR_HEAD)? {
        Head::Whole(request) => {
            is_head = request.method == "HEAD";
            if request.has_body() { Answer::sentence(413, "this server reads no body") } else { answer(&request) }
        }
        Head::Nothing => return Ok(()),
        Head::Wrong => Answer::sentence(400, "this is no request of HTTP/1.1"),
        Head::TooLong => Answer::sentence(431, "the head of a request has at most 8 KiB and 64 fields"),
        Head::TooLate => Answer::sentence(408, "the head of a request has five seconds"),
    };
    write(stream, &answer.to_bytes(is_head), start + FOR_ALL)?;
    stream.shutdown(Shutdown::Write)?;
    let (rest, mut bytes) = (Instant::now() + FOR_REST, [0; MOST_BYTES]);
    let mut left = MOST_REST;
    while left > 0 {
        match read(stream, &mut bytes, rest)? {
            0 => break,
            count => left = left.saturating_sub(count),
        }
    }
    Ok(())
}

/// The head of a request, or what is wrong with it.
enum Head {
    Whole(Request),
    /// The client sends no more before its end.
    Nothing,
    Wrong,
    TooLong,
    TooLate,
}

fn head(stream: &TcpStream, end: Instant) -> io::Result<Head> {
    let (mut bytes, mut known) = ([0; MOST_BYTES], 0);
    loop {
        let mut fields = [httparse::EMPTY_HEADER; MOST_FIELDS];
        let mut request = httparse::Request::new(&mut fields);
        match request.parse(&bytes[..known]) {
            Ok(httparse::Status::Complete(_)) => return Ok(Head::Whole(whole(&request))),
            Ok(httparse::Status::Partial) if known == MOST_BYTES => return Ok(Head::TooLong),
            Ok(httparse::Status::Partial) => {}
            Err(httparse::Error::TooManyHeaders) => return Ok(Head::TooLong),
            Err(_) => return Ok(Head::Wrong),
        }
        match read(stream, &mut bytes[known..], end) {
            Ok(0) => return Ok(Head::Nothing),
            Ok(count) => known += count,
            Err(error) if error.kind() == ErrorKind::TimedOut => return Ok(Head::TooLate),
            Err(error) => return Err(error),
        }
    }
}

fn whole(request: &httparse::Request<'_, '_>) -> Request {
    let fields = request.headers.iter().map(|field| (field.name.to_owned(), field.value.to_owned()));
    let [method, target] = [request.method, request.path].map(|text| text.unwrap_or_default().to_owned());
    Request { method, target, fields: fields.collect() }
}

/// The time that is left; an error if there is none.
fn left(end: Instant) -> io::Result<Duration> {
    let left = end.saturating_duration_since(Instant::now());
    if left.is_zero() { Err(ErrorKind::TimedOut.into()) } else { Ok(left) }
}

/// The error of a system whose name for the end of the time is another.
fn timed(error: io::Error) -> io::Error {
    if error.kind() == ErrorKind::WouldBlock { ErrorKind::TimedOut.into() } else { error }
}

/// Reads some bytes before a time.
fn read(mut stream: &TcpStream, bytes: &mut [u8], end: Instant) -> io::Result<usize> {
    stream.set_read_timeout(Some(left(end)?))?;
    stream.read(bytes).map_err(timed)
}

/// Writes all bytes before a time.
fn write(mut stream: &TcpStream, mut bytes: &[u8], end: Instant) -> io::Result<()> {
    while !bytes.is_empty() {
        stream.set_write_timeout(Some(left(end)?))?;
        match stream.write(bytes).map_err(timed)? {
            0 => return Err(ErrorKind::WriteZero.into()),
            count => bytes = &bytes[count..],
        }
    }
    Ok(())
}
