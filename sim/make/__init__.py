"""Programs made, of drawings and of other languages, proved before they are given: `Made`, `Converted`, or why not."""
