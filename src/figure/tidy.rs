//! What the tests ask of every figure.

use super::canvas::{Frame, Mark, Sheet, text_frame};

/// No text is cut off or lies on another.
pub fn assert_tidy(sheet: &Sheet) {
    let (width, height) = sheet.size();
    let texts = texts(sheet);
    for (i, (frame, text)) in texts.iter().enumerate() {
        let inside = frame.left >= 0.0
            && frame.top >= 0.0
            && frame.right <= f64::from(width)
            && frame.bottom <= f64::from(height);
        assert!(inside, "'{text}' is cut off: {frame:?}");
        for (other, second) in &texts[..i] {
            assert!(!frame.overlaps(other), "'{text}' lies on '{second}'");
        }
    }
}

/// Texts with the room they take.
pub fn texts(sheet: &Sheet) -> Vec<(Frame, &str)> {
    let text = |mark| match mark {
        &Mark::Text(at, letters, ref text) => Some((text_frame(at, &letters, text), text.as_str())),
        _ => None,
    };
    sheet.marks().iter().filter_map(text).collect()
}
