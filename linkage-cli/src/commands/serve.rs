//! `linkage serve`: the page in a browser, on a file whose changes it follows.

use std::borrow::Cow;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::net::{Ipv4Addr, TcpListener};

use crate::arguments::Serve;
use crate::failure::Failure;
use crate::listener::{Answer, Request, listen};
use crate::output;
use crate::page::{self, replaced};
use crate::source::{is_standard, read};
use crate::terminal::say;

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
    let refused = |error| Failure::Outside(format!("port {} of this machine cannot be used: {error}", arguments.port));
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, arguments.port)).map_err(refused)?;
    let port = listener.local_addr().map_err(refused)?.port();
    output::print(format!("http://{}:{port}/\n", Ipv4Addr::LOCALHOST).as_bytes())?;
    say!("the page follows {name} until you interrupt this program");
    listen(&listener, |request| answer(request, arguments, &page, port));
    Ok(())
}

/// The answer to a request for the page or for the text; nothing else can be had.
fn answer<'a>(request: &Request, arguments: &Serve, page: &'a str, port: u16) -> Answer<'a> {
    // A page of another host whose name leads here has that name in its requests.
    let hosts = [format!("{}:{port}", Ipv4Addr::LOCALHOST), format!("localhost:{port}")];
    if !request.field("Host").is_some_and(|host| hosts.iter().any(|here| here == host)) {
        return Answer::sentence(403, "this server answers 127.0.0.1 and localhost only");
    }
    if !matches!(request.method.as_str(), "GET" | "HEAD") {
        let mut answer = Answer::sentence(405, "this server is for reading only");
        answer.fields.push(("Allow", "GET, HEAD".to_owned()));
        return answer;
    }
    match request.target.split(['?', '#']).next().unwrap_or_default() {
        "/" => {
            let fields = vec![("Content-Type", "text/html; charset=utf-8".to_owned())];
            Answer { status: 200, fields, body: Cow::Borrowed(page) }
        }
        "/text" => match read(&arguments.file) {
            Ok(source) => {
                let tag = tag(&source.text);
                if request.field("If-None-Match").is_some_and(|known| known == tag) {
                    return Answer { status: 304, fields: vec![("ETag", tag)], body: Cow::Borrowed("") };
                }
                let mut answer = Answer::sentence(200, &source.text);
                answer.fields.push(("ETag", tag));
                answer
            }
            Err(mistakes) => Answer::sentence(404, &mistakes.to_text()),
        },
        _ => Answer::sentence(404, "there is the page, and nothing else"),
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

#[cfg(test)]
mod tests {
    use super::tag;

    #[test]
    fn tags_change_with_the_text() {
        assert_eq!(tag("mechanism A {}"), tag("mechanism A {}"));
        assert_ne!(tag("mechanism A {}"), tag("mechanism B {}"));
    }
}
