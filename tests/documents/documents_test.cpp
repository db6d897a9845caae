// What the documents say against what is there: programs that they quote, files and headings that
// they link to, names of the interface.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace bumper::tests {
namespace {

namespace fs = std::filesystem;

const fs::path tree = SOURCE_TREE;

std::string textOf(const fs::path& file) {
  std::ifstream stream(file);
  EXPECT_TRUE(stream) << file;
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string withoutIndent(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(' ');
  return begin == std::string::npos ? "" : line.substr(begin);
}

/// Files of the source tree with this extension, build trees and hidden folders aside.
std::vector<fs::path> filesOfTree(const std::string& extension) {
  std::vector<fs::path> files;
  for (auto it = fs::recursive_directory_iterator(tree); it != fs::recursive_directory_iterator();
       ++it) {
    const std::string name = it->path().filename().string();
    const bool isOurs = !name.starts_with('.') && name != "build" && name != "out";
    if (it->is_directory() && !isOurs) it.disable_recursion_pending();
    if (it->is_regular_file() && it->path().extension() == extension) files.push_back(it->path());
  }
  std::ranges::sort(files);
  return files;
}

std::string nameOf(const fs::path& file) { return fs::relative(file, tree).string(); }

/// A block of code under the comment "all of <file>" or "lines of <file>".
struct Quotation {
  bool isWhole = false;
  std::string file;
  std::vector<std::string> lines;
};

std::vector<Quotation> quotationsIn(const std::string& text) {
  static const std::regex comment("<!-- (all|lines) of ([^ ]+) -->");
  std::vector<Quotation> found;
  const std::vector<std::string> lines = linesOf(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::smatch match;
    if (!std::regex_match(lines[i], match, comment)) continue;
    Quotation quotation{.isWhole = match[1] == "all", .file = match[2], .lines = {}};
    for (i += 2; i < lines.size() && lines[i] != "```"; ++i) quotation.lines.push_back(lines[i]);
    found.push_back(quotation);
  }
  return found;
}

/// The first part of the quotation, up to a "...", that does not follow in the file; indents do not
/// count.
std::string strangerIn(const Quotation& quotation, const std::vector<std::string>& file) {
  std::vector<std::vector<std::string>> parts(1);
  for (const std::string& line : quotation.lines) {
    if (line == "...") {
      parts.emplace_back();
    } else {
      parts.back().push_back(withoutIndent(line));
    }
  }
  std::vector<std::string> rest;
  std::ranges::transform(file, std::back_inserter(rest), withoutIndent);
  auto from = rest.begin();
  for (const std::vector<std::string>& part : parts) {
    const auto at = std::search(from, rest.end(), part.begin(), part.end());
    if (at == rest.end()) return part.front();
    from = at + static_cast<std::ptrdiff_t>(part.size());
  }
  return "";
}

TEST(Documents, QuoteProgramsAsTheyAre) {
  std::set<std::string> quoted;
  for (const fs::path& document : filesOfTree(".md")) {
    for (const Quotation& quotation : quotationsIn(textOf(document))) {
      const std::vector<std::string> file = linesOf(textOf(tree / quotation.file));
      if (quotation.isWhole) {
        EXPECT_EQ(quotation.lines, file) << nameOf(document) << ", " << quotation.file;
      } else {
        EXPECT_FALSE(quotation.lines.empty());
        EXPECT_EQ(strangerIn(quotation, file), "") << nameOf(document) << ", " << quotation.file;
      }
      quoted.insert(quotation.file);
    }
  }
  for (const char* file : {"examples/hinge2_car.cpp", "examples/threads.cpp",
                           "tests/consumer/trials/buggy.cpp", "tests/documents/settings.cpp"}) {
    EXPECT_TRUE(quoted.contains(file)) << file;
  }
}

/// How a heading is linked to: in small letters, signs taken out, hyphens for spaces.
std::string anchorOf(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ') anchor += '-';
    if (std::isalnum(byte) != 0 || byte >= 128 || c == '-' || c == '_') {
      anchor += static_cast<char>(std::tolower(byte));
    }
  }
  return anchor;
}

/// The lines that are no code.
std::vector<std::string> proseOf(const fs::path& document) {
  std::vector<std::string> prose;
  bool isCode = false;
  for (const std::string& line : linesOf(textOf(document))) {
    if (line.starts_with("```")) {
      isCode = !isCode;
    } else if (!isCode) {
      prose.push_back(line);
    }
  }
  return prose;
}

bool hasAnchor(const fs::path& document, const std::string& anchor) {
  return std::ranges::any_of(proseOf(document), [&](const std::string& line) {
    const std::size_t begin = line.find_first_not_of('#');
    return line.starts_with('#') && begin != std::string::npos &&
           anchorOf(line.substr(begin + 1)) == anchor;
  });
}

TEST(Documents, LinkToWhatIsThere) {
  static const std::regex link(R"(\]\(([^)#]*)(#([^)]*))?\))");
  int links = 0;
  for (const fs::path& document : filesOfTree(".md")) {
    for (const std::string& line : proseOf(document)) {
      for (std::sregex_iterator it(line.begin(), line.end(), link), end; it != end; ++it) {
        const std::string target = (*it)[1];
        const std::string anchor = (*it)[3];
        if (target.find("://") != std::string::npos) continue;
        ++links;
        const fs::path file = target.empty() ? document : document.parent_path() / target;
        EXPECT_TRUE(fs::exists(file)) << nameOf(document) << ": " << target;
        if (!anchor.empty() && fs::exists(file)) {
          EXPECT_TRUE(hasAnchor(file, anchor)) << nameOf(document) << ": " << it->str();
        }
      }
    }
  }
  EXPECT_GT(links, 50);
}

/// All words of the public headers.
std::set<std::string> wordsOfHeaders() {
  static const std::regex word("[A-Za-z_][A-Za-z_0-9]*");
  std::set<std::string> words;
  for (const fs::path& header : filesOfTree(".h")) {
    if (nameOf(header).find("include/bumper/") == std::string::npos) continue;
    const std::string text = textOf(header);
    for (std::sregex_iterator it(text.begin(), text.end(), word), end; it != end; ++it) {
      words.insert(it->str());
    }
  }
  return words;
}

TEST(Documents, NameTheInterfaceAsItIs) {
  // `Type::member`, `function()`, of Bumper's own: ODE's begin with a d.
  static const std::regex name(R"(`([A-Za-z_]\w*)(::(\w+))?(\(\))?`)");
  const std::set<std::string> words = wordsOfHeaders();
  std::vector<fs::path> documents{tree / "README.md"};
  for (const auto& entry : fs::directory_iterator(tree / "engine_adapter/docs")) {
    documents.push_back(entry.path());
  }
  int names = 0;
  for (const fs::path& document : documents) {
    for (const std::string& line : proseOf(document)) {
      for (std::sregex_iterator it(line.begin(), line.end(), name), end; it != end; ++it) {
        const std::string first = (*it)[1];
        const std::string member = (*it)[3];
        const bool isCall = (*it)[4].matched;
        const bool isOfOde = first.size() > 1 && first[0] == 'd' &&
                             std::isupper(static_cast<unsigned char>(first[1])) != 0;
        if (isOfOde || first == "ODE" || first == "bumper" || (member.empty() && !isCall)) continue;
        if (first.starts_with("add_")) continue;  // of CMake
        ++names;
        EXPECT_TRUE(words.contains(first)) << nameOf(document) << ": " << it->str();
        EXPECT_TRUE(member.empty() || words.contains(member))
            << nameOf(document) << ": " << it->str();
      }
    }
  }
  EXPECT_GT(names, 40);
}

}  // namespace
}  // namespace bumper::tests
