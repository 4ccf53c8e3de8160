#include "test/daemons/speaker/odd_texts.h"

#include <random>

namespace nao::speaker {
namespace {

/** UTF-8 of a character below U+10000; also of surrogates, which no text may have. */
std::string encoded(unsigned code) {
  if (code < 0x80) return {static_cast<char>(code)};
  if (code < 0x800) {
    return {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
  }
  return {static_cast<char>(0xe0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3f)),
          static_cast<char>(0x80 | (code & 0x3f))};
}

std::string repeated(const std::string& part, size_t num_bytes) {
  std::string text;
  while (text.size() < num_bytes) text += part;
  return text;
}

const char* const kTexts[] = {
    // Empty texts, and texts without audible content.
    "",
    " ",
    "\n\n\n",
    "\t",
    "\u00a0",
    "\u3000",
    "\u200b",
    "\u200d\u200d",
    "\ufeff",
    "...",
    "!!!!!!",
    "?",
    "---",
    "_",
    "\u2026",
    "\u00ad",
    "()",
    "[]{}<>",
    "\"",
    "'",
    "\\",
    "/",
    "\u2028",
    "\u2029",
    // Emoji and other symbols.
    "\U0001f600",
    "\U0001f916",
    "\U0001f1e9\U0001f1ea",
    "\U0001f468\u200d\U0001f469\u200d\U0001f467",
    "\U0001f44d\U0001f3fd",
    "I \u2764\ufe0f robots",
    "\U0001f600\U0001f600\U0001f600\U0001f600",
    "\u2603",
    "1\ufe0f\u20e3",
    "\U0001f3f4\U000e0067\U000e0062\U000e007f",
    "\u221a2 \u2248 1.414",
    "\u20ac 5",
    "\u00bd",
    "x\u00b2 + y\u00b2",
    "\u266b",
    "\U0001d573\U0001d58a\U0001d591\U0001d591\U0001d594",
    "\U00013000",
    "\ue000\uf8ff",
    "\ufffd",
    "\ufdd0",
    "\uffff",
    "\U0010ffff",
    // Other scripts, including right-to-left ones.
    "\u0645\u0631\u062d\u0628\u0627",
    "\u05e9\u05dc\u05d5\u05dd",
    "hello \u0645\u0631\u062d\u0628\u0627 hello",
    "\u202eolleh\u202c",
    "\u2066left\u2069",
    "\u061c",
    "\u06f1\u06f2\u06f3",
    "\u4f60\u597d",
    "\u3053\u3093\u306b\u3061\u306f",
    "\u6f22\u5b57",
    "\uc548\ub155",
    "\u0e2a\u0e27\u0e31\u0e2a\u0e14\u0e35",
    "\u0928\u092e\u0938\u094d\u0924\u0947",
    "\u0ba4\u0bae\u0bbf\u0bb4\u0bcd",
    "\u1230\u120b\u121d",
    "\u041f\u0440\u0438\u0432\u0435\u0442",
    "\u0393\u03b5\u03b9\u03ac",
    "\u10d2\u10d0\u10db\u10d0\u10e0\u10ef\u10dd\u10d1\u10d0",
    "\u0531\u0532",
    "Z\u0351\u036b\u0343a\u0363\u0369l\u0348\u0358g\u0321\u034eo\u0360",
    "e\u0301",
    "\u0301\u0301\u0301",
    "\u01c4\ufb03\u00df\u0130",
    "na\u00efve caf\u00e9",
    // Markup.
    "<speak>Hello</speak>",
    "<speak><audio src=\"file:///etc/passwd\"/></speak>",
    "<speak version=\"1.0\"><voice name=\"mb-en1\">a</voice></speak>",
    "<break time=\"3600s\"/>",
    "<prosody rate=\"0.0001\">slow</prosody>",
    "<prosody volume=\"+1000dB\">loud</prosody>",
    "<mark name=\"a\"/>",
    "<!DOCTYPE a [<!ENTITY b SYSTEM \"file:///etc/passwd\">]><speak>&b;</speak>",
    "<![CDATA[a]]>",
    "<?xml?>",
    "<script>alert(1)</script>",
    "<speak",
    "</speak></speak></speak>",
    "&lt;&gt;&amp;&#0;&#x1F600;",
    "&",
    "<",
    ">",
    "<say-as interpret-as=\"tts:key\">F1</say-as>",
    "<sub alias=\"b\">a</sub>",
    "<tts:style field=\"punctuation\"/>",
    // Texts like commands and options of espeak-ng.
    "[[h@l'oU]]",
    "[[",
    "]]",
    "[[[[[[[[[[[[[[[[[[[[",
    "[[\u20ac]]",
    "_^_de",
    "((a))",
    "--stdin",
    "-f /etc/passwd",
    "-w /tmp/speech.wav hello",
    "--path=/tmp",
    "\\x01P50",
    "^A50P",
    "|||",
    "@@@@",
    "###",
    "%s%n%x%p%d",
    "%%%",
    "{0} {1}",
    // Shells, files, other programs.
    "$(reboot)",
    "`reboot`",
    "; reboot",
    "&& reboot",
    "|| reboot",
    "| sh",
    "> /tmp/a",
    ">> /tmp/a",
    "< /dev/zero",
    "hello; touch /tmp/speech-was-here",
    "$(touch /tmp/speech-was-here)",
    "`touch /tmp/speech-was-here`",
    "' ; touch /tmp/speech-was-here ; '",
    "\" ; touch /tmp/speech-was-here ; \"",
    "${PATH}",
    "$HOME",
    "~root",
    "*",
    "/etc/passwd",
    "../../../etc/passwd",
    "file:///etc/passwd",
    "\\\\host\\share",
    "!!",
    "!$",
    "\\",
    "\\n",
    "\\0",
    "'; DROP TABLE robots; --",
    "{{7*7}}",
    "${jndi:ldap://a/b}",
    "CON",
    "nul",
    "eval(1)",
    "import os",
    "() { :;}; reboot",
    ":(){ :|:& };:",
    "\n.\nQUIT\n",
    "a\r\nSet-Cookie: b",
    "a\nb\nc",
    // Numbers, dates, addresses, abbreviations, long words.
    "0",
    "-0",
    "1e308",
    "99999999999999999999999999999999999999999999999999",
    "3.14159265358979323846264338327950288",
    "1/0",
    "0x7fffffff",
    "12:99:99",
    "31.02.2026",
    "http://example.com/a?b=c&d=e#f",
    "a@b.c",
    "e.g. i.e. etc.",
    "XVIII",
    "1,000,000.00",
    "+49 (0)30 123456",
    "$1,234.56",
    "50%",
    "5 km/h",
    "H2SO4",
    "1st 2nd 3rd 4th",
    "a.b.c.d.e.f.g",
    "pneumonoultramicroscopicsilicovolcanoconiosis",
    "AAAAAAAAAAAAAAAAAAAAAAAA",
    "aAaAaAaAaA",
    "bcdfghjklmnpqrstvwxz",
    "a-b-c-d-e-f-g-h",
    "hello,hello,hello",
    "....a....b....",
    "\u201equoted\u201c \u00abtext\u00bb",
};

}  // namespace

std::vector<std::string> odd_texts() {
  std::vector<std::string> texts(std::begin(kTexts), std::end(kTexts));
  // Control characters, alone within a word.
  for (unsigned code = 0; code < 0xa0; ++code) {
    if (code >= 0x20 && code < 0x7f) continue;
    texts.push_back("a" + encoded(code) + "50P b");
  }
  // Long ones.
  for (const char* part : {"a", "a ", "7", ".", "hello world. ", "\U0001f600", "<speak>", "[[",
                           "\u0645", "\u0301", "\u4f60", "$(reboot) ", "\n"}) {
    texts.push_back(repeated(part, 10000));
    std::string longest = repeated(part, 1000);
    longest.resize(1000);
    texts.push_back(longest);
    texts.push_back(repeated(part, 996).substr(0, 996));
  }
  // No UTF-8.
  for (const char* bytes :
       {"\x80", "\xff", "\xfe\xff", "caf\xe9", "\xc3", "\xe2\x82", "\xf0\x9f\x98", "\xc0\xaf",
        "\xe0\x80\xaf", "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80", "a\x80\x80\x80"}) {
    texts.emplace_back(bytes);
  }
  for (const unsigned surrogate : {0xd800u, 0xdbffu, 0xdc00u, 0xdfffu}) {
    texts.push_back(encoded(surrogate));
  }
  std::string all_bytes;
  for (int byte = 0; byte < 256; ++byte) all_bytes += static_cast<char>(byte);
  texts.push_back(all_bytes);
  // A character of each of many blocks.
  for (unsigned code = 0xa1; code < 0xd800; code += 0x97) texts.push_back(encoded(code) + " a");
  // Words of letters, marks and symbols of all scripts.
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    std::string text;
    for (int j = 0; j < 30; ++j) {
      const unsigned code = static_cast<unsigned>(random()) % (j % 2 == 0 ? 0x3000 : 0xd800);
      text += code < 0xa0 ? " " : encoded(code);
    }
    texts.push_back(text);
  }
  return texts;
}

}  // namespace nao::speaker
