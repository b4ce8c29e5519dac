#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace glint {

/// A self-contained HTML page in two parts, with its data in between. The build's glint_page()
/// makes one from a .html file, split at its comment "<!-- DATA -->".
struct ReportPage {
  std::string_view begin, end;
};

/// A script element with JSON for the page's own script to read:
/// JSON.parse(document.getElementById(id).textContent). No text in it can end the element.
std::string jsonElement(std::string_view id, std::string json);

std::string base64(std::span<const std::byte> bytes);

/// The same for the bytes of a file, in base64.
std::string base64Element(std::string_view id, std::span<const std::byte> bytes);

}  // namespace glint
