//! Plain text tables: a header, columns as wide as their widest cell, numbers to the right.

/// Rows under a header; every row has as many cells as the header.
#[derive(Clone, Debug, Default)]
pub struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new(header: Vec<String>) -> Table {
        Table {
            header,
            rows: Vec::new(),
        }
    }

    pub fn row(&mut self, cells: Vec<String>) {
        debug_assert_eq!(cells.len(), self.header.len());
        self.rows.push(cells);
    }

    /// The table as lines, each ended.
    pub fn render(&self) -> String {
        let widths: Vec<usize> = (0..self.header.len())
            .map(|column| self.lines().map(|line| width(&line[column])).max().unwrap_or(0))
            .collect();
        let right: Vec<bool> = (0..self.header.len())
            .map(|column| self.numeric(column))
            .collect();
        let mut text = String::new();
        for line in self.lines() {
            let mut rendered = String::new();
            for ((cell, width_of_column), right) in line.iter().zip(&widths).zip(&right) {
                let gap = " ".repeat(width_of_column - width(cell));
                let cell = if *right {
                    format!("{gap}{cell}")
                } else {
                    format!("{cell}{gap}")
                };
                rendered.push_str(&cell);
                rendered.push_str("  ");
            }
            text.push_str(rendered.trim_end());
            text.push('\n');
        }
        text
    }

    fn lines(&self) -> impl Iterator<Item = &Vec<String>> {
        std::iter::once(&self.header).chain(&self.rows)
    }

    /// Whether all cells of a column that hold anything start like a number.
    fn numeric(&self, column: usize) -> bool {
        let mut cells = self
            .rows
            .iter()
            .map(|row| row[column].as_str())
            .filter(|cell| *cell != "–")
            .peekable();
        cells.peek().is_some()
            && cells.all(|cell| cell.starts_with(|first: char| first.is_ascii_digit() || first == '-'))
    }
}

fn width(text: &str) -> usize {
    text.chars().count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stand_left_numbers_right() {
        let mut table = Table::new(["scene", "width [m]", "state"].map(String::from).to_vec());
        table.row(["sphere", "0.004", "cached"].map(String::from).to_vec());
        table.row(["b", "–", "due: new"].map(String::from).to_vec());
        let expected = "scene   width [m]  state\n\
                        sphere      0.004  cached\n\
                        b               –  due: new\n";
        assert_eq!(table.render(), expected);
    }
}
