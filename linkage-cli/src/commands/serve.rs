//! `linkage serve`: the page in a browser, on a file whose changes it follows.

use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::net::Ipv4Addr;

use tiny_http::{Header, Method, Request, Response, Server, StatusCode};

use crate::arguments::Serve;
use crate::failure::Failure;
use crate::output;
use crate::page::{self, replaced};
use crate::source::{is_standard, read};

/// The policy of the page as a file, and as it is served: it may ask for the text.
const CONNECT: [&str; 2] = ["connect-src 'none'", "connect-src 'self'"];

pub fn run(arguments: &Serve) -> Result<(), Failure> {
    if is_standard(&arguments.file) {
        return Err(Failure::Argument("a page follows a file: standard input is none".to_owned()));
    }
    let name = read(&arguments.file)?.name;
    let page = page::file(arguments.page.as_deref(), "linkage.html")?;
    let page = replaced(&page, CONNECT[0], CONNECT[1])?;
    let file = format!("<head>\n<meta name=\"linkage-file\" content=\"{}\">", attribute(&name));
    let page = replaced(&page, "<head>", &file)?;
    let server = Server::http((Ipv4Addr::LOCALHOST, arguments.port)).map_err(|error| {
        Failure::Outside(format!("port {} of this machine cannot be used: {error}", arguments.port))
    })?;
    let port = server.server_addr().to_ip().map_or(arguments.port, |address| address.port());
    output::print(format!("http://{}:{port}/\n", Ipv4Addr::LOCALHOST).as_bytes())?;
    anstream::eprintln!("the page follows {name} until you interrupt this program");
    for request in server.incoming_requests() {
        // A browser that went away needs no answer.
        let _ = answer(request, arguments, &page, port);
    }
    Ok(())
}

/// Answers a request for the page or for the text; nothing else can be had.
fn answer(request: Request, arguments: &Serve, page: &str, port: u16) -> std::io::Result<()> {
    let header = |name: &'static str| {
        let found = request.headers().iter().find(|header| header.field.equiv(name));
        found.map(|header| header.value.as_str().to_owned())
    };
    // A page of another host whose name leads here has that name in its requests.
    let hosts = [format!("{}:{port}", Ipv4Addr::LOCALHOST), format!("localhost:{port}")];
    if !header("Host").is_some_and(|host| hosts.contains(&host)) {
        return request.respond(sentence(403, "this server answers 127.0.0.1 and localhost only"));
    }
    if !matches!(request.method(), Method::Get | Method::Head) {
        return request.respond(sentence(405, "this server is for reading only"));
    }
    let path = request.url().split(['?', '#']).next().unwrap_or_default().to_owned();
    match path.as_str() {
        "/" => request.respond(with(Response::from_string(page), &[("Content-Type", "text/html; charset=utf-8")])),
        "/text" => match read(&arguments.file) {
            Ok(source) => {
                let tag = tag(&source.text);
                if header("If-None-Match").is_some_and(|known| known == tag) {
                    return request.respond(with(Response::empty(304), &[("ETag", &tag)]));
                }
                let text = Response::from_string(source.text);
                request.respond(with(text, &[("Content-Type", "text/plain; charset=utf-8"), ("ETag", &tag)]))
            }
            Err(mistakes) => request.respond(sentence(404, &mistakes.to_text())),
        },
        _ => request.respond(sentence(404, "there is the page, and nothing else")),
    }
}

/// A text as the value of an attribute in double quotes.
fn attribute(text: &str) -> String {
    text.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;")
}

/// A tag that changes with the text.
fn tag(text: &str) -> String {
    let mut hasher = DefaultHasher::new();
    text.hash(&mut hasher);
    format!("\"{:016x}\"", hasher.finish())
}

fn sentence(status: u16, words: &str) -> Response<std::io::Cursor<Vec<u8>>> {
    let response = Response::from_string(words).with_status_code(StatusCode(status));
    with(response, &[("Content-Type", "text/plain; charset=utf-8")])
}

/// A response with these headers, and those of all: other sites get nothing of it, and it is read again each time.
fn with<R: std::io::Read>(response: Response<R>, headers: &[(&str, &str)]) -> Response<R> {
    let of_all = [
        ("Cache-Control", "no-store"),
        ("X-Content-Type-Options", "nosniff"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
        ("X-Frame-Options", "DENY"),
    ];
    let all = headers.iter().chain(&of_all).filter_map(|(name, value)| Header::from_bytes(*name, *value).ok());
    all.fold(response, Response::with_header)
}

#[cfg(test)]
mod tests {
    use super::tag;

    #[test]
    fn tags_change_with_the_text() {
        assert_eq!(tag("mechanism A {}"), tag("mechanism A {}"));
        assert_ne!(tag("mechanism A {}"), tag("mechanism B {}"));
    }
}
