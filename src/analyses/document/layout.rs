//! A document as HTML.

use std::fmt::Write;

use super::inputs::inputs;
use crate::model::scene::SceneFile;
use crate::page::figure::{Figure, FigureError};
use crate::page::outline::Outline;
use crate::page::text::escaped;

const STYLE: &str = "\
body{font:15px/1.45 Inter,Helvetica,Arial,sans-serif;color:#20242a;max-width:1100px;margin:2em auto;padding:0 1.5em}\
h1{font-size:1.5em;margin:0}h2{font-size:1.15em;margin:1.8em 0 .4em;border-bottom:1px solid #d6d8dc}h3{font-size:1em;margin:1.4em 0 .3em}\
p{margin:.25em 0}.facts{color:#696f78;margin:.2em 0}\
.answer{font-size:1.25em;font-weight:600;margin:.4em 0}.remarks{border-left:4px solid #c8102e;padding-left:1em}\
table{border-collapse:collapse;font-size:.9em;font-variant-numeric:tabular-nums}\
th,td{text-align:left;padding:.2em 1.2em .2em 0;border-bottom:1px solid #e9ebed;vertical-align:top}\
th{font-weight:600}td.number{text-align:right}\
figure{margin:1em 0;break-inside:avoid}figure svg{width:100%;height:auto}tr{break-inside:avoid}\
@media print{body{margin:0;max-width:none;font-size:11px}h2{break-after:avoid}}@page{margin:15mm}";

/// A report with its faces.
pub struct Document<'a> {
    /// Command that computed the report.
    pub command: &'a str,
    /// Version of sawflutter that computed it.
    pub version: &'a str,
    /// Scene of the report.
    pub scene: &'a SceneFile,
    /// Its text.
    pub outline: Outline,
    /// Its figures.
    pub figures: Vec<Figure>,
}

impl Document<'_> {
    /// Returns the page of the report.
    ///
    /// # Errors
    /// [`FigureError`] if a figure cannot be drawn.
    pub fn page(&self) -> Result<String, FigureError> {
        let drawn = self.figures.iter().map(Figure::svg);
        let figures = drawn.collect::<Result<Vec<String>, _>>()?;
        let mut text = String::new();
        // Writing to a string cannot fail, so that the result is ignored.
        let _ = write_page(&mut text, self, &figures);
        Ok(text)
    }
}

fn write_page(text: &mut String, document: &Document<'_>, figures: &[String]) -> std::fmt::Result {
    let name = escaped(&document.scene.name);
    writeln!(
        text,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{name}</title>\n<style>{STYLE}</style>\n</head>\n<body>"
    )?;
    writeln!(
        text,
        "<h1>{name}</h1>\n<p class=\"facts\">sawflutter {} {}</p>",
        escaped(document.version),
        document.command
    )?;
    writeln!(text, "<h2>Result</h2>\n{}", document.outline.in_html())?;
    writeln!(text, "<h2>Figures</h2>")?;
    for figure in figures {
        // The XML header of the drawing is removed, because HTML does not allow it.
        let drawing = figure.find("<svg").map_or("", |start| &figure[start..]);
        writeln!(text, "<figure>\n{drawing}\n</figure>")?;
    }
    scene(text, document.scene)?;
    writeln!(text, "</body>\n</html>")
}

fn paragraphs(text: &mut String, lines: &[String]) -> std::fmt::Result {
    lines
        .iter()
        .try_for_each(|line| writeln!(text, "<p>{}</p>", escaped(line)))
}

/// Writes notes and numbers of the scene, and the scene as JSON for programs that read the page.
fn scene(text: &mut String, scene: &SceneFile) -> std::fmt::Result {
    writeln!(text, "<h2>Inputs</h2>")?;
    paragraphs(text, &scene.notes)?;
    if let Some(measured) = &scene.measured {
        let line = format!(
            "Measured frequencies of {} speeds, from {}.",
            measured.rows.len(),
            measured.source
        );
        writeln!(text, "<p>{}</p>", escaped(&line))?;
    }
    text.push_str(&inputs(scene).in_html());
    // A text of the scene may contain `</script>`, which would end the element; JSON allows `<` to be
    // escaped.
    let json = serde_json::to_string(scene)
        .unwrap_or_default()
        .replace('<', "\\u003c");
    writeln!(
        text,
        "<script type=\"application/json\" id=\"scene\">{json}</script>"
    )
}

#[cfg(test)]
mod tests {
    use crate::analyses::campbell::Report;
    use crate::analyses::commands::CommandReport;
    use crate::model::scene::{Accuracy, Scene};
    use crate::stability::Analysis;

    fn report(name: &str) -> Report {
        let scene = Scene::paper().edited(|file| {
            file.accuracy = Accuracy::Draft;
            file.name = name.to_owned();
            file.operating_rpm = Some(1800.0);
        });
        Analysis::new(&scene.unwrap()).unwrap().report()
    }

    #[test]
    fn texts_of_a_scene_are_no_tags() {
        let page = report("</script><b>&\"").page().unwrap();
        assert!(!page.contains("<b>"), "a tag of the name");
        assert!(page.contains("&lt;/script&gt;&lt;b&gt;&amp;&quot;"));
        assert_eq!(page.matches("</script>").count(), 1);
    }
}
