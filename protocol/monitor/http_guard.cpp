#include "protocol/monitor/http_guard.hpp"

#include <algorithm>
#include <optional>

namespace xr3::http {
namespace {

constexpr std::string_view kLocal = "localhost";
constexpr std::string_view kPlainScheme = "http://";
constexpr std::string_view kSafeScheme = "https://";

bool is_digit(char c) { return '0' <= c && c <= '9'; }
char lower(char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool is_label_char(char c) {
  return is_digit(c) || ('a' <= lower(c) && lower(c) <= 'z') || c == '-' || c == '_';
}

bool is_port(std::string_view text) {
  return text.empty() || (text.size() <= 6 && text[0] == ':' &&
                          std::all_of(text.begin() + 1, text.end(), is_digit));
}

/// The host without its port; nullopt if the port is invalid.
std::optional<std::string_view> without_port(std::string_view host) {
  const std::size_t colon =
      host.find(':', host.starts_with('[') ? std::min(host.find(']'), host.size()) : 0);
  const std::string_view name = host.substr(0, std::min(colon, host.size()));
  if (!is_port(host.substr(name.size()))) return std::nullopt;
  return name;
}

bool is_ip4(std::string_view text) {
  int dots = 0;
  int number = -1;  // no digit yet
  for (const char c : text) {
    if (c == '.') {
      if (number < 0) return false;
      ++dots;
      number = -1;
      continue;
    }
    if (!is_digit(c)) return false;
    number = std::max(number, 0) * 10 + (c - '0');
    if (number > 255) return false;
  }
  return dots == 3 && number >= 0;
}

/// Whether the text is in brackets, which only an address can be; its value does not matter.
bool is_ip6(std::string_view text) {
  return text.size() >= 4 && text.front() == '[' && text.back() == ']' &&
         text.find(':') != std::string_view::npos &&
         text.substr(1, text.size() - 2).find_first_not_of("0123456789abcdefABCDEF:.") ==
             std::string_view::npos;
}

/// A final dot makes a name absolute in the DNS; it names the same host.
std::string_view without_final_dot(std::string_view name) {
  if (name.ends_with('.')) name.remove_suffix(1);
  return name;
}

bool is_localhost(std::string_view name) {
  if (is_same_name(name, kLocal)) return true;
  if (!is_host_name(name) || name.size() <= kLocal.size()) return false;
  const std::string_view front = name.substr(0, name.size() - kLocal.size());
  return front.back() == '.' && is_same_name(name.substr(front.size()), kLocal);
}

/// Whether this is a name without a dot. Numbers are excluded: browsers treat 2130706433, for
/// example, as an address.
bool is_single_label(std::string_view name) {
  return is_host_name(name) && name.find('.') == std::string_view::npos &&
         !std::all_of(name.begin(), name.end(), is_digit) && !name.starts_with("0x") &&
         !name.starts_with("0X");
}

bool is_local_name(std::string_view name) {
  return is_ip4(name) || is_ip6(name) || is_localhost(without_final_dot(name));
}

}  // namespace

bool is_host_allowed(std::string_view host, const GuardRules& rules) {
  const auto name = without_port(host);
  if (!name) return false;
  const auto is_this = [&](const std::string& allowed) {
    return is_same_name(without_final_dot(*name), allowed);
  };
  return is_local_name(*name) || (rules.reach == HostReach::kBeyond && is_single_label(*name)) ||
         std::any_of(rules.hosts.begin(), rules.hosts.end(), is_this);
}

bool is_origin_allowed(std::string_view origin, std::string_view host, const GuardRules& rules) {
  if (origin.starts_with(kPlainScheme) && origin.substr(kPlainScheme.size()) == host) return true;
  return std::find(rules.origins.begin(), rules.origins.end(), origin) != rules.origins.end();
}

bool is_desktop_allowed(std::string_view origin, const GuardRules& rules) {
  const bool is_of_app = origin == "null" || origin.starts_with("file://");
  return is_of_app && std::find(rules.origins.begin(), rules.origins.end(), kDesktopOrigin) !=
                          rules.origins.end();
}

bool is_local_host(std::string_view host) {
  const auto name = without_port(host);
  return name && is_local_name(*name);
}

bool is_host_name(std::string_view name) {
  const auto is_allowed = [](char c) { return is_label_char(c) || c == '.'; };
  return !name.empty() && name.front() != '.' && name.back() != '.' &&
         name.find("..") == std::string_view::npos &&
         std::all_of(name.begin(), name.end(), is_allowed);
}

bool is_origin(std::string_view text) {
  const std::string_view scheme = text.starts_with(kSafeScheme) ? kSafeScheme : kPlainScheme;
  if (!text.starts_with(scheme)) return false;
  const auto name = without_port(text.substr(scheme.size()));
  return name && !text.ends_with(':') && (is_host_name(*name) || is_ip6(*name));
}

bool is_same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace xr3::http
