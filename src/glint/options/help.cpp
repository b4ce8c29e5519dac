#include "glint/options/help.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace glint {
namespace {

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::string result, line(indent, ' ');
  std::size_t begin = 0;
  while (begin < text.size()) {
    std::size_t end = text.find(' ', begin);
    if (end == std::string::npos) end = text.size();
    if (line.size() > indent && line.size() + 1 + end - begin > width) {
      result += line + "\n";
      line.assign(indent, ' ');
    }
    if (line.size() > indent) line += ' ';
    line.append(text, begin, end - begin);
    begin = end + 1;
  }
  return result + line + "\n";
}

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row.back();
}

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t bestDistance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& each : known) {
    const std::size_t distance = editDistance(word, each);
    if (distance < bestDistance) {
      bestDistance = distance;
      best = each;
    }
  }
  return best;
}

}  // namespace

std::string HelpFormatter::make_option(const CLI::Option* option, bool isPositional) const {
  std::string head = "  " + option->get_name(isPositional, true);
  if (!isPositional && !option->get_type_name().empty() && option->get_items_expected_max() > 0)
    head += " " + option->get_type_name();
  return head + "\n" + wrapped(option->get_description(), 6, 100);
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  std::string usage = "Usage: " + name;
  if (!app->get_subcommands({}).empty()) usage += " COMMAND";
  for (const CLI::Option* option : app->get_options())
    if (option->get_positional())
      usage += option->get_required() ? " " + option->get_name(true)
                                      : " [" + option->get_name(true) + "]";
  const CLI::Option* output = app->get_option_no_throw("--output");
  if (output != nullptr && output->get_required()) usage += "... -o OUT";
  return usage + " [OPTIONS]\n";
}

std::string usageMessage(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const auto used = app.get_subcommands();
  const CLI::App& command = used.empty() ? app : *used.front();
  const std::string where = used.empty() ? "" : command.get_name() + ": ";
  const std::string remedy =
      ": see glint " + (used.empty() ? "" : command.get_name() + " ") + "--help";
  if (dynamic_cast<const CLI::RequiredError*>(&error) && used.empty()) {
    if (argc > 1 && argv[1][0] != '-') {
      std::vector<std::string> names;
      for (const CLI::App* each : app.get_subcommands({})) names.push_back(each->get_name());
      const std::string best = nearest(argv[1], names);
      return "unknown command '" + std::string(argv[1]) + "'" +
             (best.empty() ? remedy : ": did you mean '" + best + "'?");
    }
    return "no command" + remedy;
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
    const std::vector<std::string> extras = app.remaining(true);
    const std::string word =
        extras.empty() ? "" : extras.front().substr(0, extras.front().find('='));
    if (used.empty()) return "unknown command or option '" + word + "'" + remedy;
    if (word.empty() || word[0] != '-') return where + "unexpected '" + word + "'" + remedy;
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    const std::string best = nearest(word, names);
    return where + "unknown option '" + word + "'" +
           (best.empty() ? remedy : ": did you mean '" + best + "'?");
  }
  std::string text = error.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return where + text + remedy;
}

}  // namespace glint
