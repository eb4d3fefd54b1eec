#include "report/page/html_page.h"

#include <openssl/evp.h>

#include "page_style.h"

namespace regrasp::report {

std::string DataUri(std::string_view media_type, std::string_view bytes) {
  // Three bytes become four characters; the encoder adds a zero.
  std::string base64((bytes.size() + 2) / 3 * 4 + 1, '\0');
  const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(base64.data()),
                                   reinterpret_cast<const unsigned char*>(bytes.data()),
                                   static_cast<int>(bytes.size()));
  base64.resize(size);
  return "data:" + std::string(media_type) + ";base64," + base64;
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

std::string Policy(PictureSource pictures) {
  const std::string policy =
      "default-src 'none'; style-src 'unsafe-inline'; media-src data:; img-src data:";
  // Some browsers give a file no site of its own.
  return policy + (pictures == PictureSource::kOwnSite ? " 'self' file:" : "");
}

}  // namespace

std::string FormatHtmlPage(std::string_view title, const std::vector<Element>& parts,
                           PictureSource pictures) {
  Element style("style");
  style.AddVerbatim(kPageStyle);
  const std::vector<Element> head = {
      Element("meta", {{"charset", "utf-8"}}),
      Element("meta", {{"http-equiv", "Content-Security-Policy"}, {"content", Policy(pictures)}}),
      Element("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}}),
      Element("title", {}, title), style};
  const std::vector<Element> main = {Element("main", {}, parts)};
  const std::vector<Element> page = {Element("head", {}, head), Element("body", {}, main)};
  const Attributes language = {{"lang", "en"}, {"xmlns", "http://www.w3.org/1999/xhtml"}};
  return "<!DOCTYPE html>\n" + Element("html", language, page).Format() + "\n";
}

Element PageHeader(std::string_view kind, std::string_view subject, bool passed,
                   std::string_view statement, std::string_view extent) {
  const std::string verdict =
      (passed ? "Pass" : "Fail") + (extent.empty() ? "" : " " + std::string(extent));
  return Element(
      "header", {},
      std::vector<Element>{Element("p", {{"class", "kicker"}}, kind), Element("h1", {}, subject),
                           Element("p", {{"class", passed ? "verdict pass" : "verdict fail"}},
                                   Element("strong", {}, verdict), " ", statement)});
}

}  // namespace regrasp::report
