#include "server/resources/sites.hpp"

#include <nettle/base64.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "cell/sha256.hpp"
#include "protocol/json/source.hpp"
#include "server/files/data_files.hpp"
#include "server/resources/web_assets.hpp"

namespace xr3 {
namespace {

namespace fs = std::filesystem;
using http::Answer;

constexpr std::size_t kLargestFile = 16UL * 1024 * 1024;

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

/// The documentation has the origin of the robot's page, which keeps a token: no other scripts than
/// those that were installed. (The style sheets have icons as data.)
std::string policy_of_page(std::string_view html) {
  return "default-src 'self'; script-src 'self'" + inline_sources(html, "script") +
         "; style-src 'self'" + inline_sources(html, "style") +
         "; img-src 'self' data:; frame-ancestors 'none'; base-uri 'none'";
}

/// The policy that clients/web/build.mjs writes into the page, here for all of its files, and the
/// permission for the documentation to frame it.
std::string policy_of_robot(std::string_view) {
  return "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:; "
         "img-src 'self' data: blob:; font-src 'none'; object-src 'none'; base-uri 'self'; "
         "form-action 'none'; frame-ancestors 'self'";
}

// --- Sites.

struct Site {
  std::string_view root;  ///< path, without the slash at the end
  const char* title;      ///< for messages
  const char* script;     ///< builds the site
  const char* installed;  ///< folder in an installation
  const char* built;      ///< folder in a checkout
  std::string (*policy)(std::string_view text);

  fs::path folder() const { return installed_folder(installed, built); }
};

constexpr std::array<Site, 2> kSites{{
    {"/docs", "the documentation", "scripts/site", "docs", "build/site", policy_of_page},
    {"/play", "the robot without a server", "scripts/playground", "play", "build/playground",
     policy_of_robot},
}};

const Site* site_of(std::string_view path) {
  const auto* found = std::ranges::find_if(kSites, [path](const Site& site) {
    return path.starts_with(site.root) &&
           (path.size() == site.root.size() || path[site.root.size()] == '/');
  });
  return found == kSites.end() ? nullptr : found;
}

Answer not_installed(const Site& site) {
  const std::string script = site.script;
  return http::error(404, "not_found", site.title + (" is not here; " + script) + " builds it",
                     "run " + script + " in the checkout, or install a package of xr3");
}

Answer no_such_file(const Site& site) {
  return http::not_found(std::string(site.title) + " has no such file");
}

Answer list_sites() {
  Json paths = Json::array();
  std::error_code error;
  for (const Site& site : kSites)
    if (fs::is_directory(site.folder(), error)) paths.push_back(std::string(site.root) + "/");
  return http::json(paths.dump() + "\n");
}

}  // namespace

// --- Files.

/// Reads the files, in the worker.
class Sites::Files {
 public:
  Answer answer(const Site& site, const std::string& path) {
    try {
      const fs::path folder = fs::canonical(site.folder());
      const auto place = place_of(folder, path.ends_with('/') ? path + "index.html" : path);
      return of_place(site, place, path);
    } catch (const fs::filesystem_error&) {
      return not_installed(site);
    } catch (const FileError&) {
      return no_such_file(site);
    }
  }

 private:
  struct SiteFile {
    std::string text;
    std::string policy;
  };
  using SiteFilePtr = std::shared_ptr<const SiteFile>;

  Answer of_place(const Site& site, const std::optional<fs::path>& place, const std::string& path) {
    std::error_code error;
    if (place && fs::is_directory(*place, error))
      return moved_to(std::string(site.root) + path + "/");
    if (!place || !fs::is_regular_file(*place, error)) return no_such_file(site);
    const SiteFilePtr file = file_at(site, *place);
    return {200,
            std::string(web_type(place->string())),
            http::Body(std::shared_ptr<const std::string>(file, &file->text)),
            {{"Content-Security-Policy", file->policy}}};
  }

  SiteFilePtr file_at(const Site& site, const fs::path& place) {
    std::weak_ptr<const SiteFile>& sending = sending_[place];
    if (SiteFilePtr file = sending.lock()) return file;
    std::string text = read_file(place, kLargestFile).text;
    std::string policy = site.policy(text);
    SiteFilePtr made = std::make_shared<const SiteFile>(std::move(text), std::move(policy));
    sending = made;
    return made;
  }

  std::map<fs::path, std::weak_ptr<const SiteFile>> sending_;
};

Sites::Sites(Worker& worker) : worker_(worker), files_(std::make_shared<Files>()) {}

bool Sites::has(std::string_view path) { return site_of(path) != nullptr; }

asio::awaitable<Answer> Sites::list() {
  auto work = [] { return list_sites(); };  // g++ 12: as in pictures.cpp
  co_return co_await worker_.run(std::move(work));
}

asio::awaitable<Answer> Sites::answer(std::string path) {
  assert(has(path));
  const Site& site = *site_of(path);
  path.erase(0, site.root.size());
  if (has(path)) co_return moved_to(path);  // the documentation has links to /play/ as to its own
  auto work = [files = files_, &site, path] { return files->answer(site, path); };
  co_return co_await worker_.run(std::move(work));
}

}  // namespace xr3
