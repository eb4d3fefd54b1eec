#include "report/page/html_page.h"

#include <algorithm>
#include <cstddef>

#include "page_style.h"
#include "render/viewer/viewer_scene.h"

namespace regrasp::report {

std::string DataUri(std::string_view media_type, std::string_view bytes) {
  return "data:" + std::string(media_type) + ";base64," + render::Base64(bytes);
}

std::string PathUri(std::string_view path) {
  constexpr std::string_view kAsTheyAre =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string uri;
  for (const char byte : path) {
    if (kAsTheyAre.find(byte) != std::string_view::npos) {
      uri += byte;
      continue;
    }
    const auto value = static_cast<unsigned char>(byte);
    uri += {'%', kHex[value / 16], kHex[value % 16]};
  }
  return uri;
}

namespace {

/// Return the text of a script element, which is the same in HTML and in XML.
std::string ScriptText(std::string_view script) {
  return "//<![CDATA[\n" + std::string(script) + "\n//]]>";
}

std::string Policy(PictureSource pictures, const std::vector<std::string>& scripts) {
  std::string policy =
      "default-src 'none'; style-src 'unsafe-inline'; media-src data:; img-src data:";
  // Some browsers give a file no site of its own.
  if (pictures == PictureSource::kOwnSite) policy += " 'self' file:";
  if (!scripts.empty()) policy += "; script-src";
  for (const std::string& script : scripts) policy += " '" + render::ScriptHash(script) + "'";
  return policy;
}

}  // namespace

std::string FormatHtmlPage(std::string_view title, const std::vector<Element>& parts,
                           PictureSource pictures, std::span<const std::string_view> scripts,
                           std::string_view more_style) {
  std::vector<std::string> texts;
  for (const std::string_view script : scripts) texts.push_back(ScriptText(script));
  Element style("style");
  style.AddVerbatim(kPageStyle);
  style.AddVerbatim(more_style);
  const std::vector<Element> head = {
      Element("meta", {{"charset", "utf-8"}}),
      Element("meta",
              {{"http-equiv", "Content-Security-Policy"}, {"content", Policy(pictures, texts)}}),
      Element("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}}),
      Element("title", {}, title), style};
  std::vector<Element> main = {Element("main", {}, parts)};
  for (const std::string& text : texts) main.emplace_back("script").AddVerbatim(text);
  const std::vector<Element> page = {Element("head", {}, head), Element("body", {}, main)};
  const Attributes language = {{"lang", "en"}, {"xmlns", "http://www.w3.org/1999/xhtml"}};
  return "<!DOCTYPE html>\n" + Element("html", language, page).Format() + "\n";
}

Element WithOptions(Element element, std::string_view text) {
  constexpr std::string_view kOfOption = "abcdefghijklmnopqrstuvwxyz0123456789-";
  for (;;) {
    std::size_t begin = text.find("--");
    while (begin != std::string_view::npos && begin > 0 && text[begin - 1] != ' ' &&
           text[begin - 1] != '(') {
      begin = text.find("--", begin + 1);
    }
    if (begin == std::string_view::npos) break;
    const std::size_t end = std::min(text.find_first_not_of(kOfOption, begin), text.size());
    element.Add(text.substr(0, begin));
    element.Add(Element("span", {{"class", "option"}}, text.substr(begin, end - begin)));
    text.remove_prefix(end);
  }
  element.Add(text);
  return element;
}

Element PageHeader(std::string_view kind, std::string_view subject, bool passed,
                   std::string_view statement, std::string_view extent) {
  const std::string verdict =
      (passed ? "Pass" : "Fail") + (extent.empty() ? "" : " " + std::string(extent));
  return Element("header", {},
                 std::vector<Element>{
                     Element("p", {{"class", "kicker"}}, kind), Element("h1", {}, subject),
                     WithOptions(Element("p", {{"class", passed ? "verdict pass" : "verdict fail"}},
                                         Element("strong", {}, verdict), " "),
                                 statement)});
}

}  // namespace regrasp::report
