//! The exports of the module: a question is written into room that the module gives, and the answer read where it lies.
//!
//! Plain exports, so that no generated code stands between the page and the module. The page writes and reads the bytes
//! themselves in the memory of the module; here are lengths and addresses only.

use std::cell::RefCell;

use crate::Session;

#[derive(Default)]
struct Exchange {
    session: Session,
    question: Vec<u8>,
    answer: String,
}

thread_local! {
    static EXCHANGE: RefCell<Exchange> = RefCell::default();
}

/// A function of the module by its name, which the lint on unsafe code asks about: two functions of one name would be one.
macro_rules! export {
    ($(#[$about:meta])* fn $name:ident($($argument:ident: u32)?) -> u32 $body:block) => {
        $(#[$about])*
        #[allow(unsafe_code, reason = "the names are those of this file alone")]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name($($argument: u32)?) -> u32 $body
    };
}

/// The progress of a long answer, from 0 to 1, which the page shows.
fn progress(part: f64) {
    #[allow(unsafe_code, reason = "the page gives the function, which takes any number")]
    mod page {
        #[link(wasm_import_module = "page")]
        unsafe extern "C" {
            pub safe fn progress(part: f64);
        }
    }
    page::progress(part);
}

export! {
    /// Gives room for a question of so many bytes, and returns its address.
    fn room(length: u32) -> u32 {
        EXCHANGE.with_borrow_mut(|exchange| {
            exchange.question = vec![0; length as usize];
            exchange.question.as_mut_ptr() as usize as u32
        })
    }
}

export! {
    /// Answers the question that was written, and returns the number of bytes of the answer.
    fn ask() -> u32 {
        EXCHANGE.with_borrow_mut(|exchange| {
            let question = std::mem::take(&mut exchange.question);
            exchange.answer = exchange.session.ask(&String::from_utf8_lossy(&question), &mut progress);
            exchange.answer.len() as u32
        })
    }
}

export! {
    /// The address of the answer.
    fn answer() -> u32 {
        EXCHANGE.with_borrow(|exchange| exchange.answer.as_ptr() as usize as u32)
    }
}
