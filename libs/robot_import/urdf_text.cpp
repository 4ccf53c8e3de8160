#include "robot_import/urdf_text.h"

#include <iconv.h>

#include <algorithm>
#include <cerrno>
#include <regex>
#include <vector>

namespace nao {
namespace {

/** @return false if the bytes are not text in this encoding, or iconv does not know it. */
bool convert(const std::string& bytes, const std::string& encoding, std::string& text) {
  const iconv_t converter = iconv_open("UTF-8", encoding.c_str());
  if (converter == reinterpret_cast<iconv_t>(-1)) return false;
  std::string input = bytes;
  char* from = input.data();
  size_t left = input.size();
  text.clear();
  std::vector<char> buffer(1 << 16);
  size_t failed = 0;
  while (left > 0) {
    char* to = buffer.data();
    size_t room = buffer.size();
    failed = iconv(converter, &from, &left, &to, &room);
    text.append(buffer.data(), to);
    if (failed == static_cast<size_t>(-1) && errno != E2BIG) break;
    failed = 0;
  }
  iconv_close(converter);
  return failed == 0;
}

bool starts(const std::string& bytes, std::initializer_list<int> with) {
  return bytes.size() >= with.size() &&
         std::equal(with.begin(), with.end(), bytes.begin(),
                    [](int value, char byte) { return value == (byte & 0xff); });
}

/** The encoding of the bytes by their first ones, Extensible Markup Language 1.0, appendix F;
 * empty: that of ASCII. */
std::string find_wide_encoding(const std::string& bytes) {
  if (starts(bytes, {0xff, 0xfe, 0, 0})) return "UTF-32";
  if (starts(bytes, {0xff, 0xfe}) || starts(bytes, {0xfe, 0xff})) return "UTF-16";
  if (starts(bytes, {'<', 0})) return "UTF-16LE";
  if (starts(bytes, {0, '<'})) return "UTF-16BE";
  return "";
}

std::string find_stated_encoding(const std::string& bytes) {
  std::smatch match;
  const std::string head = bytes.substr(0, 200);
  static const std::regex stated("<\\?xml[^>]*encoding\\s*=\\s*[\"']([A-Za-z0-9._-]+)");
  return std::regex_search(head, match, stated) ? match[1].str() : "";
}

/** Blanks out what no reader here needs, so that lines keep their numbers. */
void blank(std::string& text, size_t from, size_t to) {
  std::replace_if(
      text.begin() + static_cast<long>(from), text.begin() + static_cast<long>(to),
      [](char letter) { return letter != '\n'; }, ' ');
}

void remove_doctype(std::string& text) {
  const size_t start = text.find("<!DOCTYPE");
  if (start == std::string::npos || start > text.find("<robot")) return;
  size_t end = text.find_first_of("[>", start);
  // An internal subset has elements of its own.
  if (end != std::string::npos && text[end] == '[') end = text.find('>', text.find(']', end));
  if (end != std::string::npos) blank(text, start, end + 1);
}

}  // namespace

std::string to_xml_text(const std::string& bytes, RepairLog& log) {
  const auto note = [&](const std::string& problem, const std::string& remedy) {
    log.findings.push_back({Finding::Severity::kRepaired, log.file, 0, "", problem, remedy});
  };
  std::string text = bytes;
  std::string encoding = find_wide_encoding(bytes);
  std::string same;
  if (encoding.empty() && !convert(bytes, "UTF-8", same)) {
    encoding = find_stated_encoding(bytes);
    if (encoding.empty() || encoding == "UTF-8" || encoding == "utf-8") encoding = "WINDOWS-1252";
  }
  if (!encoding.empty()) {
    if (!convert(bytes, encoding, text)) {
      log.fail(nullptr, "is not text in " + encoding, "save it as UTF-8");
    }
    note("is not UTF-8", "it is read as " + encoding + ": save it as UTF-8");
  }
  if (starts(text, {0xef, 0xbb, 0xbf})) text.erase(0, 3);
  std::replace(text.begin(), text.end(), '\0', ' ');
  const size_t start = std::min(text.find("<?xml"), text.find("<robot"));
  const size_t first = text.find('<');
  if (start != std::string::npos && text.find_first_not_of(" \t\r\n") < std::min(first, start)) {
    blank(text, 0, first);
    note("has text above its first element", "it is left out");
  }
  // TinyXML reads a declaration only at the start, and believes the encoding that it states.
  if (const size_t declaration = text.find("<?xml"); declaration != std::string::npos) {
    const size_t end = text.find("?>", declaration);
    if (end != std::string::npos) blank(text, declaration, end + 2);
  }
  remove_doctype(text);
  return text;
}

}  // namespace nao
