#include "glint/budget/cost_file.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/json_text.h"
#include "glint/image/printable.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

constexpr int version = 1;
constexpr double mostCost = 1e6;

// The only list of a file's contents: calls visit(group, name, cost in the table) for each entry.
template <class Table, class Visit>
void forCosts(Table& table, const Visit& visit) {
  for (auto& [form, costs] : table.lobes) visit("highlight", row(form).name, costs);
  for (const auto& [group, costs] : {std::pair("fresnel", &table.fresnel),
                                     std::pair("fresnel-denser-side", &table.fresnelDenser)}) {
    for (const FresnelRow& form : fresnelRows()) {
      visit(group, form.name, costs->*form.cost);
      if (form.form == Fresnel::schlick) visit(group, "schlick-exponent", costs->schlickExponent);
    }
  }
}

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  CostFile read() const {
    const auto bytes = readFile(path_);
    std::string error;
    const std::optional<Json> parsed =
        parseJsonText<Json>({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, error);
    if (!parsed) fail("is " + error);
    const Json& json = *parsed;
    if (!json.is_object() || !json.contains("glint-costs")) fail("is not a cost table");
    if (json["glint-costs"] != version)
      fail("is a cost table of version " + printable(json["glint-costs"].dump(), 40) +
           ", and this glint reads " + std::to_string(version));
    CostFile file;
    std::size_t known = 0;
    forCosts(file.costs, [&](const char* group, std::string_view name, auto& cost) {
      const std::string full = std::string(group) + " " + std::string(name);
      if (!json.contains(group) || !json[group].is_object() || !json[group].contains(name))
        fail("lacks the cost of " + full);
      set(json[group][std::string(name)], full, cost);
      ++known;
    });
    if (json["highlight"].size() + json["fresnel"].size() + json["fresnel-denser-side"].size() !=
        known)
      fail("has the cost of a form that this version does not know");
    if (json.contains("noise")) set(json["noise"], "noise", file.noise);
    const Json gl = json.value("gl", Json::object());
    const auto text = [&](const char* key) {
      return gl.is_object() && gl.contains(key) && gl[key].is_string() ? gl[key].get<std::string>()
                                                                       : std::string();
    };
    file.gl = {text("vendor"), text("renderer"), text("version")};
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(printablePath(path_) + ": " + what +
                     ": make one with glint study --measure-costs FILE");
  }

  void set(const Json& json, const std::string& name, double& cost) const {
    if (!json.is_number()) fail(name + " is not a number");
    cost = json.get<double>();
    if (!(cost >= 0 && cost <= mostCost)) fail(name + " is not from 0 to 1e6");
  }

  void set(const Json& json, const std::string& name, std::vector<double>& costs) const {
    if (costs.size() == 1) return set(json, name, costs[0]);
    if (!json.is_array() || json.size() != costs.size())
      fail(name + " is not a list of " + std::to_string(costs.size()) + " numbers");
    for (std::size_t i = 0; i < costs.size(); ++i) set(json[i], name, costs[i]);
  }

  const std::string& path_;
};

}  // namespace

std::string costFileText(const CostFile& file) {
  Json json{
      {"glint-costs", version},
      {"gl",
       {{"vendor", file.gl.vendor}, {"renderer", file.gl.renderer}, {"version", file.gl.version}}},
      {"noise", file.noise},
      {"highlight", Json::object()},
      {"fresnel", Json::object()},
      {"fresnel-denser-side", Json::object()}};
  forCosts(file.costs, [&](const char* group, std::string_view name, const auto& cost) {
    Json& entry = json[group][std::string(name)];
    entry = cost;
    if constexpr (!std::is_same_v<decltype(cost), const double&>)
      if (cost.size() == 1) entry = cost[0];
  });
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

CostFile readCostFile(const std::string& path) { return Reader(path).read(); }

CostTable costTableFor(const Look& look) {
  return look.costTable.empty() ? CostTable() : readCostFile(look.costTable).costs;
}

}  // namespace glint
