#include "csv_reader.h"

#include <stdexcept>

#include "text_file.h"

namespace bumper::testing {

std::vector<CsvRow> parseCsv(std::string_view text) {
  std::vector<CsvRow> rows;
  CsvRow row;
  std::string field;
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char letter = text[k];
    if (quoted) {
      const bool doubled = letter == '"' && k + 1 < text.size() && text[k + 1] == '"';
      if (letter != '"') {
        field += letter;
      } else if (doubled) {
        field += '"';
        ++k;
      } else {
        quoted = false;
      }
    } else if (letter == '"') {
      quoted = true;
    } else if (letter == ',' || letter == '\n') {
      row.push_back(field);
      field.clear();
      if (letter == '\n') {
        rows.push_back(row);
        row.clear();
      }
    } else {
      field += letter;
    }
  }
  return rows;
}

std::vector<CsvRecord> readCsv(const std::filesystem::path& file) {
  const std::vector<CsvRow> rows = parseCsv(readText(file));
  std::vector<CsvRecord> records;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    if (rows[k].size() != rows[0].size()) {
      throw std::runtime_error(file.string() + ", row " + std::to_string(k + 1) + " has " +
                               std::to_string(rows[k].size()) + " fields instead of " +
                               std::to_string(rows[0].size()));
    }
    CsvRecord& record = records.emplace_back();
    for (std::size_t i = 0; i < rows[0].size(); ++i) record[rows[0][i]] = rows[k][i];
  }
  return records;
}

}  // namespace bumper::testing
