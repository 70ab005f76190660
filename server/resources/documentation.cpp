#include "server/resources/documentation.hpp"

#include <nettle/base64.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <filesystem>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "cell/sha256.hpp"
#include "server/files/data_files.hpp"
#include "server/resources/web_assets.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;
using http::Answer;

constexpr std::string_view kRoot = "/docs";

Answer not_installed() {
  return http::error(404, "not_found", "the documentation is not here; scripts/site builds it",
                     "run scripts/site in the checkout, or install a package of xr3");
}

Answer moved_to(const std::string& path) {
  return {301, "text/plain; charset=utf-8", http::Body::of_static(""), {{"Location", path}}};
}

/// The file or folder of a path; nullopt if it does not exist, or is not in the folder of the site,
/// which has no symbolic link in its name.
std::optional<fs::path> place_of(const fs::path& folder, const std::string& path) {
  std::error_code error;
  fs::path place = fs::canonical(folder.string() + "/" + path, error);
  const bool is_inside = (place / "").string().starts_with((folder / "").string());
  return !error && is_inside ? std::optional(std::move(place)) : std::nullopt;
}

// --- Content-Security-Policy.

/// The source that allows an inline element with this text.
std::string hash_source(std::string_view text) {
  const Sha256 digest = sha256_bytes(text);
  std::array<char, BASE64_ENCODE_RAW_LENGTH(Sha256{}.size())> base64{};
  base64_encode_raw(base64.data(), digest.size(), digest.data());
  return " 'sha256-" + std::string(base64.data(), base64.size()) + "'";
}

/// The sources that allow the inline elements of a page with this name, `script` or `style`.
std::string inline_sources(std::string_view html, const std::string& name) {
  std::string sources;
  for (std::size_t at = html.find("<" + name); at < html.size(); at = html.find("<" + name, at)) {
    at = std::min(html.find('>', at), html.size() - 1) + 1;
    const std::string_view text = html.substr(at, html.find("</" + name, at) - at);
    if (!text.empty()) sources += hash_source(text);
  }
  return sources;
}

/// The site has the origin of the robot's page, which keeps a token: no other scripts than those
/// that were installed. (The style sheets have icons as data.)
std::string policy_of(std::string_view html) {
  return "default-src 'self'; script-src 'self'" + inline_sources(html, "script") +
         "; style-src 'self'" + inline_sources(html, "style") +
         "; img-src 'self' data:; frame-ancestors 'none'; base-uri 'none'";
}

}  // namespace

// --- Files.

/// Reads the files, in the worker.
class Documentation::Site {
 public:
  Answer answer(const std::string& path) {
    try {
      const fs::path folder = fs::canonical(documentation_folder());
      return of_place(place_of(folder, path.ends_with('/') ? path + "index.html" : path), path);
    } catch (const fs::filesystem_error&) {
      return not_installed();
    } catch (const FileError&) {
      return http::not_found("the documentation has no such file");
    }
  }

 private:
  struct SiteFile {
    std::string text;
    std::string policy;
  };
  using SiteFilePtr = std::shared_ptr<const SiteFile>;

  Answer of_place(const std::optional<fs::path>& place, const std::string& path) {
    std::error_code error;
    if (place && fs::is_directory(*place, error)) return moved_to(std::string(kRoot) + path + "/");
    if (!place || !fs::is_regular_file(*place, error))
      return http::not_found("the documentation has no such file");
    const SiteFilePtr file = file_at(*place);
    return {200,
            std::string(web_type(place->string())),
            http::Body(std::shared_ptr<const std::string>(file, &file->text)),
            {{"Content-Security-Policy", file->policy}}};
  }

  SiteFilePtr file_at(const fs::path& place) {
    std::weak_ptr<const SiteFile>& sending = sending_[place];
    if (SiteFilePtr file = sending.lock()) return file;
    std::string text = read_file(place).text;
    std::string policy = policy_of(text);
    SiteFilePtr made = std::make_shared<const SiteFile>(std::move(text), std::move(policy));
    sending = made;
    return made;
  }

  std::map<fs::path, std::weak_ptr<const SiteFile>> sending_;
};

Documentation::Documentation(Worker& worker) : worker_(worker), site_(std::make_shared<Site>()) {}

bool Documentation::has(std::string_view path) {
  return path.starts_with(kRoot) && (path.size() == kRoot.size() || path[kRoot.size()] == '/');
}

asio::awaitable<Answer> Documentation::answer(std::string path) {
  assert(has(path));
  path.erase(0, kRoot.size());
  auto work = [site = site_, path] { return site->answer(path); };  // g++ 12: as in pictures.cpp
  co_return co_await worker_.run(std::move(work));
}

}  // namespace xr3
