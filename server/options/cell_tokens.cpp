#include "server/options/cell_tokens.hpp"

#include <sys/stat.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "server/files/atomic_write.hpp"
#include "server/options/options.hpp"

namespace xr3 {
namespace {

constexpr const char* kTokensEnding = ".tokens";
constexpr ::mode_t kPrivate = S_IRUSR | S_IWUSR;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw FileError(path + ": " + why +
                  "; it has the tokens of the robots as {\"name\": \"token\"}: mend it, or move it "
                  "away, and print new slips");
}

CellTokens tokens_of(const nlohmann::json& json, const std::string& path) {
  CellTokens tokens;
  for (const auto& [name, token] : json.items()) {
    if (!is_cell_name(name) || !token.is_string()) refuse(path, "contains no names with tokens");
    try {
      tokens.emplace(name, checked_token(token.get<std::string>(), "the token of " + name));
    } catch (const TokenError& error) {
      refuse(path, error.what());
    }
  }
  return tokens;
}

void write_tokens(const std::string& path, const CellTokens& tokens) {
  Draft draft(path, kPrivate);
  draft.append(nlohmann::json(tokens).dump(1) + "\n");
  draft.sync();
  draft.take_name(Existing::kReplace);
}

/// The kept token of a cell, which is made if it has none. Returns whether it was made.
bool assign_kept(CellPlan& plan, CellTokens& kept) {
  const auto [at, is_new] = kept.try_emplace(plan.name);
  if (is_new) at->second = read_token(FreshToken{});
  plan.token = at->second;
  return is_new;
}

void refuse_equal(const std::vector<CellPlan>& plans) {
  std::map<std::string, std::string> owners;
  for (const CellPlan& plan : plans) {
    const auto [owner, is_new] = owners.emplace(plan.token, plan.name);
    if (!is_new)
      throw TokenError("cells " + owner->second + " and " + plan.name +
                       " have the same token: each needs its own");
  }
}

}  // namespace

CellTokens read_cell_tokens(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {};
  if (others_may_read(path))
    throw FileError(path + ": every user of this machine can read the tokens in it; type: chmod " +
                    "600 " + path);
  const auto json = nlohmann::json::parse(read_file(path).text, nullptr, false);
  if (!json.is_object()) refuse(path, "is no JSON object");
  return tokens_of(json, path);
}

void assign_tokens(const ServeOptions& options, std::vector<CellPlan>& plans) {
  if (!options.is_private || !has_many_cells(options)) return;
  const bool is_kept = !options.roster.empty();
  const std::string path = options.roster + kTokensEnding;
  CellTokens kept = is_kept ? read_cell_tokens(path) : CellTokens{};
  bool has_new = false;
  for (CellPlan& plan : plans) {
    if (!plan.token_file.empty())
      plan.token = read_token(TokenFile{plan.token_file});
    else
      has_new = assign_kept(plan, kept) || has_new;
  }
  refuse_equal(plans);
  if (is_kept && has_new) write_tokens(path, kept);
}

}  // namespace xr3
