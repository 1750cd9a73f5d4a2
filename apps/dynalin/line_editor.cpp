#include "line_editor.h"

#include <histedit.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <cwchar>
#include <string_view>

#include "command/completion.h"
#include "command/interruption.h"

namespace {

// In the home of the user, unless the environment says otherwise; empty for none.
std::string history_file() {
  if (const char* named = std::getenv("DYNALIN_HISTORY")) return named;
  const char* home = std::getenv("HOME");
  return home ? std::string(home) + "/.dynalin_history" : std::string();
}

constexpr int lines_kept = 1000;
constexpr wchar_t end_of_input = 4;  // Ctrl-D

}  // namespace

struct LineEditor::Inside {
  EditLine* editor = ::el_init("dynalin", stdin, stdout, stderr);
  History* history = ::history_init();
  HistEvent event{};
  std::string prompt;
  const dynalin::Model* model = nullptr;

  static Inside& of(EditLine* el) {
    void* inside = nullptr;
    ::el_get(el, EL_CLIENTDATA, &inside);
    return *static_cast<Inside*>(inside);
  }
  static char* show_prompt(EditLine* el) { return of(el).prompt.data(); }
  static unsigned char complete(EditLine* el, int);
  static int read_character(EditLine*, wchar_t* character);
};

// One character of the terminal. An interruption ends the line, which is thrown away then.
int LineEditor::Inside::read_character(EditLine*, wchar_t* character) {
  std::mbstate_t state{};
  for (;;) {
    if (dynalin::interrupted()) {
      *character = L'\n';
      return 1;
    }
    char byte = 0;
    const ssize_t count = ::read(STDIN_FILENO, &byte, 1);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return static_cast<int>(count);
    const std::size_t length = std::mbrtowc(character, &byte, 1, &state);
    if (length == static_cast<std::size_t>(-2)) continue;  // more bytes belong to it
    if (length == static_cast<std::size_t>(-1)) *character = static_cast<unsigned char>(byte);
    // The end of input typed while a command ran comes as a zero: the terminal's own line discipline had it then.
    if (byte == 0) *character = end_of_input;
    return 1;
  }
}

// As far as all that may follow agree; where nothing is added, all of it is shown.
unsigned char LineEditor::Inside::complete(EditLine* el, int) {
  const LineInfo* line = ::el_line(el);
  const std::string_view text(line->buffer, static_cast<std::size_t>(line->cursor - line->buffer));
  const std::vector<std::string> words = dynalin::completions(text, of(el).model);
  if (words.empty()) return CC_ERROR;
  std::size_t begun = 0;
  while (begun < text.size()) {
    const auto c = static_cast<unsigned char>(text[text.size() - 1 - begun]);
    if (std::isalnum(c) == 0 && c != '_') break;
    ++begun;
  }
  std::string common = words.front();
  for (const std::string& word : words) {
    std::size_t same = 0;
    while (same < common.size() && same < word.size() && common[same] == word[same]) ++same;
    common.resize(same);
  }
  if (common.size() > begun || words.size() == 1) {
    ::el_deletestr(el, static_cast<int>(begun));
    const bool inserted = ::el_insertstr(el, common.c_str()) == 0;
    return inserted ? CC_REFRESH : CC_ERROR;
  }
  std::fputc('\n', stdout);
  constexpr std::size_t width = 100;
  std::size_t column = 0;
  for (const std::string& word : words) {
    if (column + word.size() + 2 > width) std::fputc('\n', stdout), column = 0;
    column += static_cast<std::size_t>(std::fprintf(stdout, "%s  ", word.c_str()));
  }
  std::fputc('\n', stdout);
  return CC_REDISPLAY;
}

LineEditor::LineEditor() {
  std::setlocale(LC_CTYPE, "");  // characters of several bytes
  inside_ = std::make_unique<Inside>();
  EditLine* el = inside_->editor;
  if (!el) return;
  ::el_set(el, EL_CLIENTDATA, inside_.get());
  ::el_set(el, EL_PROMPT, &Inside::show_prompt);
  ::el_set(el, EL_EDITOR, "emacs");
  ::el_set(el, EL_SIGNAL, 0);
  ::el_set(el, EL_GETCFN, &Inside::read_character);
  ::el_wset(el, EL_ADDFN, L"dynalin-complete", L"what may stand next", &Inside::complete);  // el_set leaks its copies
  ::el_set(el, EL_BIND, "^I", "dynalin-complete", nullptr);
  ::history(inside_->history, &inside_->event, H_SETSIZE, lines_kept);
  ::history(inside_->history, &inside_->event, H_SETUNIQUE, 1);
  ::el_set(el, EL_HIST, ::history, inside_->history);
  if (const std::string file = history_file(); !file.empty())
    ::history(inside_->history, &inside_->event, H_LOAD, file.c_str());
  ::el_source(el, nullptr);
}

LineEditor::~LineEditor() {
  if (const std::string file = history_file(); !file.empty())
    ::history(inside_->history, &inside_->event, H_SAVE, file.c_str());
  ::history_end(inside_->history);
  if (inside_->editor) ::el_end(inside_->editor);
}

std::optional<std::string> LineEditor::next(const std::string& prompt, const dynalin::Model* model) {
  if (!inside_->editor) return std::nullopt;
  inside_->prompt = prompt, inside_->model = model;
  int count = 0;
  errno = 0;
  const char* line = ::el_gets(inside_->editor, &count);
  if (dynalin::interrupted()) {  // Ctrl-C takes the line back
    dynalin::forget_interruption();
    std::fputs("^C\n", stdout);
    return "";
  }
  if (!line || count <= 0) {
    std::fputc('\n', stdout);
    return std::nullopt;
  }
  std::string text(line, static_cast<std::size_t>(count));
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  if (text.find_first_not_of(" \t") != std::string::npos)
    ::history(inside_->history, &inside_->event, H_ENTER, text.c_str());
  return text;
}
