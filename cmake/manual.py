"""Generates manual pages, completions and the reference of options from the programs' help.

    manual.py --glint GLINT [--viewer GLINT_VIEWER] [--folder FOLDER] [--markdown FILE]

runs `GLINT --help-json` and writes man1/*.1, bash/glint, zsh/_glint and fish/glint.fish into FOLDER,
and docs/options.md as FILE. Without the window's program `glint view` has no options.
"""

import argparse
import json
import pathlib
import re
import subprocess

FILES = ("FILE", "OUT", "IN", "MODEL", "A", "B", "PICTURE")
FOLDERS = ("DIR", "FOLDER")

STATUS = [
    ("0", "done, or same"),
    ("1", "differs, or a check failed"),
    ("2", "wrong usage or unreadable input"),
    ("3", "no OpenGL context"),
    ("4", "no baseline"),
]
VARIABLES = [
    ("GLINT_UPDATE_BASELINES", "with the value 1, image tests make or replace their baselines"),
    ("GLINT_IMAGE_TEST_OUTPUT", "the folder in which image tests leave pictures and results"),
]


def described(program):
    return json.loads(subprocess.run([program, "--help-json"], stdout=subprocess.PIPE, check=True,
                                     text=True).stdout)


def choices(option):
    """The words that a value may be, if they are known."""
    if option.get("choices"):
        return option["choices"]
    parts = option["value"].split("|")
    return [p for p in parts if re.fullmatch(r"[a-z0-9][a-z0-9:-]*", p)] if len(parts) > 1 else []


def kind(option):
    """What a shell completes a value to: "files", "folders", or "" for only the choices."""
    words = set(re.split(r"[^A-Z]+", option["value"]))
    return "files" if words & set(FILES) else "folders" if words & set(FOLDERS) else ""


def first_clause(text):
    """The part of a help text that is shown beside a name in a menu."""
    return re.split(r"[:;(\[]| - ", text)[0].strip()[:78]


# Manual pages.

def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("`", "\\(ga")
    text = text.replace("^", "\\(ha").replace("~", "\\(ti")
    return "\\&" + text if text.startswith(".") else text


def roff_options(options):
    lines = []
    for option in options:
        names = ", ".join("\\fB%s\\fR" % roff(n) for n in option["names"])
        value = " \\fI%s\\fR" % roff(option["value"]) if option["value"] else ""
        lines += [".TP", names + value, roff(option["help"])]
    return lines


def man_page(name, command, version, title, whole):
    lines = ['.TH %s 1 "" "glint %s" "User commands"' % (name.upper().replace("-", "\\-"), version)]
    summary = command["description"].split("\n")[0].rstrip(".")
    lines += [".SH NAME", "%s \\- %s" % (roff(name), roff(title or summary))]
    lines.append(".SH SYNOPSIS")
    words = ["\\fB%s\\fR" % roff(name.replace("-", " ") if command is not whole else name)]
    if "commands" in command:
        words.append("\\fICOMMAND\\fR")
    for each in command["arguments"]:
        text = "\\fI%s\\fR%s" % (roff(each["value"]), "..." if each["many"] else "")
        words.append(text if each["required"] else "[%s]" % text)
    for each in command["options"]:
        if each["required"]:
            words.append("\\fB%s\\fR \\fI%s\\fR" % (roff(each["names"][0]), roff(each["value"])))
    lines.append(" ".join(words + ["[\\fIOPTIONS\\fR]"]))
    lines += [".SH DESCRIPTION"]
    for paragraph in command["description"].split("\n"):
        lines += [roff(paragraph), ".PP"]
    lines.pop()
    if command["arguments"]:
        lines += [".SH ARGUMENTS"] + roff_options(dict(a, names=[a["value"]], value="")
                                                  for a in command["arguments"])
    if "commands" in command:
        lines.append(".SH COMMANDS")
        for each in command["commands"]:
            lines += [".TP", "\\fBglint %s\\fR(1)" % each["name"], roff(each["description"])]
    for section in sections(command):
        title = "OPTIONS" if section == "Options" else section.upper()
        lines += [".SH " + ('"%s"' % roff(title))]
        lines += roff_options(o for o in command["options"] if o["section"] == section)
    lines.append('.SH "EXIT STATUS"')
    for number, meaning in STATUS:
        lines += [".TP", "\\fB%s\\fR" % number, meaning]
    if command is whole:
        lines.append(".SH ENVIRONMENT")
        for variable, meaning in VARIABLES:
            lines += [".TP", "\\fB%s\\fR" % roff(variable), roff(meaning)]
    examples = command["footer"].split("\n")[1:]
    if examples:
        lines += [".SH EXAMPLES", ".nf"] + [roff(e.strip()) for e in examples] + [".fi"]
    others = ["glint"] + ["glint-" + c["name"] for c in whole["commands"]]
    lines += ['.SH "SEE ALSO"', ",\n".join("\\fB%s\\fR(1)" % roff(o) for o in others if o != name)]
    return "\n".join(lines) + "\n"


def sections(command):
    return list(dict.fromkeys(o["section"] for o in command["options"]))


# Completions. Each command has a list of options; each option with a value has its words or kind.

def bash(whole):
    commands = whole["commands"]
    names = {c["name"]: " ".join(n for o in c["options"] for n in o["names"]) for c in commands}
    options = "\n".join('    %s) echo "%s" ;;' % each for each in names.items())
    cases = {}
    for c in commands:
        for option in c["options"]:
            if not option["value"]:
                continue
            words = " ".join(choices(option))
            does = ('words "%s"' % words if words else "") + (
                "; " if words and kind(option) else "") + kind(option)
            for name in option["names"]:
                cases.setdefault(does or "true", []).append("%s:%s" % (c["name"], name))
    values = "\n".join("    %s)\n      %s ;;" % (" | ".join(keys), does)
                       for does, keys in cases.items())
    top = " ".join([c["name"] for c in commands] + ["help"] +
                   [n for o in whole["options"] for n in o["names"]])
    return """# bash completion for glint                                    -*- shell-script -*-

_glint_options() {
  case $1 in
%s
  esac
}

# Completes the word $3 after option $2 of command $1; false if that option is a flag or unknown.
_glint_value() {
  local current=$3
  words() { COMPREPLY+=($(compgen -W "$1" -- "$current")); }
  files() { compopt -o filenames 2>/dev/null; COMPREPLY+=($(compgen -f -- "$current")); }
  folders() { compopt -o filenames 2>/dev/null; COMPREPLY+=($(compgen -d -- "$current")); }
  local status=0 IFS=$' \\t\\n'
  case $1:$2 in
%s
    *) status=1 ;;
  esac
  unset -f words files folders
  return $status
}

_glint() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]}
  COMPREPLY=()
  # --name=value comes as three words.
  if [[ $current == = ]]; then
    current=
  elif [[ $before == = ]]; then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi
  if [[ $COMP_CWORD -gt 1 && $before == -* ]] && _glint_value "$command" "$before" "$current"; then
    return
  fi
  if [[ $COMP_CWORD -eq 1 || ( $COMP_CWORD -eq 2 && $command == help ) ]]; then
    COMPREPLY=($(compgen -W "%s" -- "$current"))
  elif [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$(_glint_options "$command")" -- "$current"))
    return
  fi
  if [[ $current != -* ]]; then
    compopt -o filenames 2>/dev/null
    local IFS=$'\\n'
    COMPREPLY+=($(compgen -f -- "$current"))
  fi
}
complete -F _glint glint
""" % (options, values, top)


def fish_text(text):
    return "'%s'" % text.replace("\\", "\\\\").replace("'", "\\'")


def fish(whole):
    lines = ["# fish completion for glint"]
    for each in whole["commands"]:
        lines.append("complete -c glint -n __fish_use_subcommand -a %s -d %s"
                     % (each["name"], fish_text(first_clause(each["description"]))))
    for command in [whole] + whole["commands"]:
        when = ("__fish_use_subcommand" if command is whole else
                "__fish_seen_subcommand_from " + command["name"])
        for option in command["options"]:
            words = ["complete -c glint -n", "'%s'" % when]
            for name in option["names"]:
                words.append(("-l " if name.startswith("--") else "-s ") + name.lstrip("-"))
            if option["value"]:
                words.append("-r" if kind(option) else "-x")
                given = choices(option)
                if given:
                    words.append("-a '%s'" % " ".join(given))
                elif kind(option) == "folders":
                    words.append("-a '(__fish_complete_directories)'")
            words.append("-d " + fish_text(first_clause(option["help"])))
            lines.append(" ".join(words))
    return "\n".join(lines) + "\n"


def zsh_text(text):
    text = first_clause(text).replace("\\", "\\\\")
    return re.sub(r"([\[\]:])", r"\\\1", text).replace("'", "'\\''")


def zsh(whole):
    def spec(option):
        action = ""
        if option["value"]:
            given, files = choices(option), kind(option)
            name = re.sub(r"[^A-Za-z0-9,|%/ -]", " ", option["value"]).strip() or "value"
            action = ":%s:" % name.replace("|", " or ")
            if given and not files:
                action += "(%s)" % " ".join(re.sub(r"([:\\])", r"\\\1", g) for g in given)
            elif files:
                action += "_files -/" if files == "folders" else "_files"
            else:
                action += " "
        return ["'*%s[%s]%s'" % (name, zsh_text(option["help"]), action)
                for name in option["names"]]

    commands = "\n".join("    '%s:%s'" % (c["name"], zsh_text(c["description"]))
                         for c in whole["commands"])
    cases = "\n".join("    %s)\n      _arguments \\\n        %s \\\n        '*:file:_files' ;;" % (
        c["name"], " \\\n        ".join(s for o in c["options"] for s in spec(o)) or "'-:'")
        for c in whole["commands"])
    return """#compdef glint

_glint() {
  local -a commands=(
%s
  )
  if (( CURRENT == 2 )); then
    _describe command commands
    _arguments %s
    _files -g '*.(glb|gltf)'
    return
  fi
  local command=$words[2]
  words=("${words[@]:1}")
  (( CURRENT-- ))
  case $command in
    help) _describe command commands ;;
%s
  esac
}

_glint "$@"
""" % (commands, " ".join(s for o in whole["options"] for s in spec(o)), cases)


# The page.

def markdown(whole):
    def table(options):
        lines = []
        for option in options:
            names = ", ".join("`%s`" % n for n in option["names"])
            value = " `%s`" % option["value"] if option["value"] else ""
            if not option["names"][0].startswith("-"):
                value = ""
            lines.append("- %s%s: %s" % (names, value, plain(option["help"])))
        return lines + [""]

    def plain(text):
        return re.sub(r"([*_<>\[\]|])", r"\\\1", text)

    lines = [
        "# Options\n",
        "This page lists all options of all commands, as `glint COMMAND --help` prints them; it is",
        "generated from the same table as the manual pages and the shells' completions.",
        "`--name value` and `--name=value` both work. Vectors are `x,y,z`; colours are `r,g,b` in",
        "linear light, or `#rrggbb` in sRGB. A look is everything that determines a picture of a",
        "model: the options of [a look](#a-look) are also the keys of look files, and the names by",
        "which C++ and Python set them.\n",
        "`glint --help-json` and `glint-viewer --help-json` give the same to programs, as JSON.\n",
    ]
    shared = None
    for command in whole["commands"]:
        lines += ["## glint %s\n" % command["name"], plain(command["description"]).split("\n")[0] + "\n"]
        if command["arguments"]:
            lines += table(command["arguments"])
        looks = [o for o in command["options"] if o["look"]]
        own = [o for o in command["options"] if not o["look"]]
        for section in dict.fromkeys(o["section"] for o in own):
            if section != "Options":
                lines.append("### %s\n" % section)
            lines += table(o for o in own if o["section"] == section)
        if looks:
            if shared is None:
                shared = looks
            missing = [o for o in looks if o["names"] not in [s["names"] for s in shared]]
            if missing:
                raise SystemExit("options of a look that only `%s` has" % command["name"])
            lines.append("And the options of [a look](#a-look).\n")
    lines += ["## A look\n"]
    for section in dict.fromkeys(o["section"] for o in shared or []):
        lines.append("### %s\n" % section)
        lines += table(o for o in shared if o["section"] == section)
    lines += ["## Exit status\n", "| status | meaning |", "|---|---|"]
    lines += ["| %s | %s |" % each for each in STATUS]
    lines += ["\n## Environment\n", "| variable | meaning |", "|---|---|"]
    lines += ["| `%s` | %s |" % each for each in VARIABLES]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--glint", required=True)
    parser.add_argument("--viewer")
    parser.add_argument("--folder", type=pathlib.Path)
    parser.add_argument("--markdown", type=pathlib.Path)
    given = parser.parse_args()
    whole = described(given.glint)
    version = subprocess.run([given.glint, "--version"], stdout=subprocess.PIPE, check=True,
                             text=True).stdout.split()[1]
    if given.viewer:
        view = next(c for c in whole["commands"] if c["name"] == "view")
        summary = view["description"]
        view.update({k: v for k, v in described(given.viewer).items() if k != "name"})
        view["description"] = summary + "\n" + view["description"]
    if given.markdown:
        given.markdown.write_text(markdown(whole))
    if not given.folder:
        return
    files = {"bash/glint": bash(whole), "zsh/_glint": zsh(whole), "fish/glint.fish": fish(whole)}
    files["man1/glint.1"] = man_page("glint", whole, version,
                                     "draw and compare glTF models with the classic shading models", whole)
    for command in whole["commands"]:
        name = "glint-" + command["name"]
        files["man1/%s.1" % name] = man_page(name, command, version, "", whole)
    files["man1/glint-viewer.1"] = ".so man1/glint-view.1\n"
    for name, text in files.items():
        path = given.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


main()
