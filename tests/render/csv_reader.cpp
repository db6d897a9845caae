#include "csv_reader.h"

#include <fstream>
#include <iterator>

namespace bumper::testing {

std::string readText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<CsvRow> parseCsv(const std::string& text) {
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

}  // namespace bumper::testing
