linkage::linkage! {
    #[deprecated]
    mechanism Marked {
        #[cfg(test)]
        param r = 1;
        #[serde(skip)]
        input v;
        unknown u;
        #[inline]
        equation u = r * v;
        /// The doc comment of a field.
        output twice = 2 * v;
        body b {
            /// For the reader.
            mass r;
            #[cfg(test)]
            center r@v;
        }
        /// The doc comment of a type.
        scene Loaded { #[allow(unused)] gravity (0, -9.81); } // `allow` is under test.
    }
}

linkage::linkage! {
    #[derive(Clone) nonsense]
    mechanism Cut {
        input v;
        unknown u;
        equation u = 2 * v;
    }
}

fn main() {}
