//! Addresses and connections.

use std::io;
use std::net::SocketAddr;
use std::time::Duration;

use serde::de::DeserializeOwned;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::time::{Instant, sleep, timeout};

use super::ClusterError;

/// The time after which a scheduler that accepts a connection, and does not answer, is given up.
const ANSWER: Duration = Duration::from_secs(5);
/// The time between two questions whether a cluster is ready.
const PAUSE: Duration = Duration::from_millis(100);

/// Listens at `host:port`; port 0 takes one that is free.
pub(super) async fn listen(
    role: &'static str,
    host: &str,
    port: u16,
) -> Result<(TcpListener, SocketAddr), ClusterError> {
    let error = |source| ClusterError::Listen { role, address: format!("{host}:{port}"), source };
    let listener = TcpListener::bind((host, port)).await.map_err(error)?;
    let address = listener.local_addr().map_err(error)?;
    Ok((listener, address))
}

/// Checks that there is a scheduler.
pub(super) async fn answers(scheduler: &str) -> Result<(), ClusterError> {
    ask(scheduler, "/healthz").await.map(drop)
}

/// Waits until a scheduler has executors.
pub(super) async fn ready(scheduler: &str, wait: Duration) -> Result<(), ClusterError> {
    // A time that no clock has is never over.
    let end = Instant::now().checked_add(wait);
    loop {
        let answer = ask(scheduler, "/readyz").await?;
        if answer.split(' ').nth(1) == Some("200") {
            return Ok(());
        }
        if end.is_some_and(|end| Instant::now() >= end) {
            let answer = answer.lines().last().unwrap_or_default().to_owned();
            return Err(ClusterError::NotReady { address: scheduler.to_owned(), seconds: wait.as_secs(), answer });
        }
        sleep(PAUSE).await;
    }
}

/// The answer of a scheduler in JSON; none if it does not answer or says something else.
pub(super) async fn json<T: DeserializeOwned>(scheduler: &str, path: &str) -> Option<T> {
    let answer = ask(scheduler, path).await.ok()?;
    let (_, body) = answer.split_once("\r\n\r\n")?;
    serde_json::from_str(body).ok()
}

/// The answer of a scheduler.
async fn ask(scheduler: &str, path: &str) -> Result<String, ClusterError> {
    let answer = timeout(ANSWER, get(scheduler, path)).await;
    let silent = || io::Error::new(io::ErrorKind::TimedOut, format!("silent for {} s", ANSWER.as_secs()));
    let unreachable = |source| ClusterError::Unreachable { address: scheduler.to_owned(), source };
    answer.unwrap_or_else(|_| Err(silent())).map_err(unreachable)
}

/// The answer of an HTTP server.
async fn get(address: &str, path: &str) -> io::Result<String> {
    let mut stream = TcpStream::connect(address).await?;
    let request = format!("GET {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n");
    stream.write_all(request.as_bytes()).await?;
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).await?;
    Ok(String::from_utf8_lossy(&answer).into_owned())
}
