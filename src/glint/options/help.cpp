#include "glint/options/help.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <sstream>
#include <vector>

namespace glint {
namespace {

constexpr std::size_t helpWidth = 80;  // a terminal's

/// Wraps the text to helpWidth columns, every line indented by `indent` spaces, except that the
/// first continues `line`.
std::string wrapped(const std::string& text, std::size_t indent, std::string line = {}) {
  std::string result;
  line.resize(std::max(line.size(), indent), ' ');
  bool first = true;  // at the start of a line
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (!first && line.size() + 1 + end - begin > helpWidth) {
      result += line + "\n";
      line.assign(indent, ' ');
      first = true;
    }
    if (!first) line += ' ';
    line.append(text, begin, end - begin);
    first = false;
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
  if (!best.empty() || word.size() < 4) return best;
  // Otherwise a longer name that starts with the word: --background for --background-color.
  for (const std::string& each : known)
    if (each.starts_with(word) && (best.empty() || each.size() < best.size())) best = each;
  return best;
}

/// An option with its value, and its description below.
std::string optionHelp(const CLI::Option& option, bool positional) {
  std::string head = "  " + option.get_name(positional, true);
  if (!positional && !option.get_type_name().empty() && option.get_items_expected_max() > 0)
    head += " " + option.get_type_name();
  return head + "\n" + wrapped(option.get_description(), 6);
}

std::string usage(const CLI::App& app, const std::string& name) {
  std::string text = "Usage: " + name;
  if (!app.get_subcommands({}).empty()) text += " COMMAND";
  for (const CLI::Option* option : app.get_options()) {
    const bool positional = option->get_positional();
    const auto& letters = option->get_snames();
    std::string word = positional        ? option->get_name(true)
                       : letters.empty() ? option->get_name()
                                         : "-" + letters.front();
    if (!positional) word += " " + option->get_type_name();
    if (positional && option->get_items_expected_max() > 1) word += "...";
    if (option->get_required())
      text += " " + word;
    else if (positional)
      text += " [" + word + "]";
  }
  return text + " [OPTIONS]\n";
}

/// The command's name for the user: "glint render"; the window program's name is already
/// "glint view".
std::string fullName(const CLI::App& app, const CLI::App& command) {
  return &app == &command ? app.get_name() : app.get_name() + " " + command.get_name();
}

std::vector<std::string> optionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> commandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* each : app.get_subcommands({})) names.push_back(each->get_name());
  return names;
}

std::string didYouMean(const std::string& best, const std::string& otherwise) {
  return best.empty() ? otherwise : ": did you mean '" + best + "'?";
}

}  // namespace

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode) const {
  std::string text;
  std::istringstream paragraphs(app->get_description());
  for (std::string each; std::getline(paragraphs, each);) text += wrapped(each, 0);
  text += "\n" + usage(*app, name);
  const auto section = [&](const std::string& title, const std::vector<const CLI::Option*>& options,
                           bool positional) {
    if (options.empty()) return;
    text += "\n" + title + ":\n";
    for (const CLI::Option* option : options) text += optionHelp(*option, positional);
  };
  section("Arguments",
          app->get_options([](const CLI::Option* each) { return each->get_positional(); }), true);
  for (const std::string& group : app->get_groups())
    section(group, app->get_options([&](const CLI::Option* each) {
      return each->nonpositional() && each->get_group() == group;
    }),
            false);
  const std::vector<const CLI::App*> commands = app->get_subcommands({});
  if (!commands.empty()) text += "\nCommands:\n";
  for (const CLI::App* each : commands)
    text += wrapped(each->get_description(), 15, "  " + each->get_name());
  if (!app->get_footer().empty()) text += "\n" + app->get_footer() + "\n";
  return text;
}

std::string examples(std::initializer_list<const char*> lines) {
  std::string text = "Examples:";
  for (const char* line : lines) text += std::string("\n  glint ") + line;
  return text;
}

std::string usageMessage(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const auto used = app.get_subcommands();
  const CLI::App& command = used.empty() ? app : *used.front();
  const std::string where = used.empty() ? "" : command.get_name() + ": ";
  const std::string remedy = ": see " + fullName(app, command) + " --help";

  const std::vector<std::string> names = commandNames(app);
  if (used.empty() && !names.empty() && argc > 1 && argv[1][0] != '-')
    return "unknown command '" + std::string(argv[1]) + "'" +
           didYouMean(nearest(argv[1], names), remedy);

  // Unknown options come first, even if something is missing: a misspelt option is the likelier
  // error.
  const std::vector<std::string> extras = app.remaining(true);
  const auto unknown = std::ranges::find_if(extras, [](const std::string& word) {
    return word.size() > 1 && word[0] == '-' && !std::isdigit(static_cast<unsigned char>(word[1]));
  });
  if (unknown != extras.end()) {
    const std::string word = unknown->substr(0, unknown->find('='));
    return where + "unknown option '" + word + "'" +
           didYouMean(nearest(word, optionNames(command)), remedy);
  }
  if (used.empty() && !names.empty()) return "no command" + remedy;
  if (dynamic_cast<const CLI::ExtrasError*>(&error))
    return where + "unexpected '" + (extras.empty() ? "" : extras.front()) + "'" + remedy;
  std::string text = error.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return where + text + remedy;
}

}  // namespace glint
