#include "nastran/configuration_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "dataset/characters.h"
#include "dataset/dataset.h"

namespace dynalin::nastran {

namespace {

class Parser {
 public:
  Parser(const SourceText& source, Diagnostics& diagnostics)
      : source_(source), text_(source.text()), diagnostics_(diagnostics) {}

  std::vector<WrittenItem> parse() {
    for (skip_space(); at_ < text_.size(); skip_space()) item();
    return std::move(items_);
  }

 private:
  // --- characters ---
  bool at_end() const { return at_ >= text_.size(); }
  char now() const { return text_[at_]; }
  Span span(std::size_t begin, std::size_t end) const {
    return {&source_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)};
  }
  void skip_blanks() {
    while (!at_end() && is_blank(now())) ++at_;
  }
  void skip_line() {
    while (!at_end() && !is_line_end(now())) ++at_;
  }
  // Blanks, ends of lines and comments.
  void skip_space() {
    while (!at_end()) {
      if (now() == '$')
        skip_line();
      else if (is_blank(now()) || is_line_end(now()))
        ++at_;
      else
        return;
    }
  }
  std::size_t word_end(std::size_t begin) const {
    std::size_t end = begin;
    if (end < text_.size() && is_word_start(text_[end])) {
      while (end < text_.size() && is_word_part(text_[end])) ++end;
    }
    return end;
  }
  // `word =` begins here.
  bool is_assignment(std::size_t begin) const {
    std::size_t end = word_end(begin);
    if (end == begin) return false;
    while (end < text_.size() && is_blank(text_[end])) ++end;
    return end < text_.size() && text_[end] == '=';
  }
  void syntax(const Span& at, std::string message, std::string hint = {}) {
    diagnostics_.error("directive-syntax", at, std::move(message), std::move(hint));
  }

  // --- values ---
  // What stands behind the equals sign, up to the end of the line, a comment, or what `ends` says.
  template <class Ends>
  Span value(const Ends& ends) {
    skip_blanks();
    const std::size_t begin = at_;
    std::size_t end = begin;
    for (; !at_end() && !is_line_end(now()) && now() != '$' && !ends(); ++at_) {
      if (!is_blank(now())) end = at_ + 1;
    }
    return span(begin, end);
  }
  bool after_blank() const { return at_ > 0 && is_blank(text_[at_ - 1]); }

  // --- items ---
  void item() {
    const Span key = span(at_, word_end(at_));
    if (key.length == 0) {
      syntax(span(at_, at_ + 1), fmt::format("a directive begins with its name, not with {}", now()));
      return skip_line();
    }
    at_ += key.length;
    skip_blanks();
    if (!at_end() && now() == '=') {
      ++at_;
      return directive(key);
    }
    skip_space();
    if (!at_end() && now() == '{') {
      ++at_;
      return block(key);
    }
    if (known(key)) syntax(key, fmt::format("{} is followed by {}", key.text(), is_block(key.text()) ? "{" : "="));
    if (at_end() || source_.place(static_cast<std::uint32_t>(at_)).line == source_.place(key.offset).line) skip_line();
  }
  static bool is_block(std::string_view name) { return name == "verbatim" || find_block(name); }
  bool known(const Span& key) {
    if (is_block(key.text()) || find_directive(key.text())) return true;
    const std::vector<std::string_view> names = directive_names();
    const std::string_view near = nearest_word(key.text(), names);
    diagnostics_.error("unknown-directive", key, fmt::format("there is no directive {}", key.text()),
                       near.empty() ? "`dynalin help export` lists them" : fmt::format("{} exists", near));
    return false;
  }

  void directive(const Span& key) {
    const Directive* d = find_directive(key.text());
    // Titles are text to the end of the line.
    const bool text = d && d->rule == TextRule::case_control_line;
    const Span written = value([&] {
      return !text && after_blank() && is_assignment(at_) && find_directive(text_.substr(at_, word_end(at_) - at_));
    });
    if (!known(key)) return;
    if (!d) return syntax(key, fmt::format("{} is a block: {} {{ … }}", key.text(), key.text()));
    WrittenItem item;
    item.directive = d;
    item.written = {key, written};
    items_.push_back(std::move(item));
  }

  void block(const Span& key) {
    if (key.text() == "verbatim") return verbatim(key);
    const Block* b = find_block(key.text());
    if (known(key) && !b) syntax(key, fmt::format("{} is no block: {} = …", key.text(), key.text()));
    WrittenItem item;
    item.block = b;
    item.written = {key, key};
    const std::size_t before = diagnostics_.error_count();
    for (skip_space(); !at_end() && now() != '}'; skip_space()) field(item);
    if (at_end()) return syntax(key, fmt::format("{} has no }} at its end", key.text()));
    ++at_;
    if (!b || diagnostics_.error_count() > before) return;
    for (const Field& f : b->fields) {
      const bool given = std::ranges::any_of(item.fields, [&](const WrittenValue& w) { return names(f, w); });
      if (f.required && !given)
        diagnostics_.error("missing-directive", key, fmt::format("{} needs {}", b->name, f.name));
    }
    if (diagnostics_.error_count() == before) items_.push_back(std::move(item));
  }
  static bool names(const Field& f, const WrittenValue& w) {
    return w.key.text() == f.name || (!f.also.empty() && w.key.text() == f.also);
  }

  void field(WrittenItem& item) {
    const Span key = span(at_, word_end(at_));
    if (key.length == 0) {
      syntax(span(at_, at_ + 1), fmt::format("in a block a field begins with its name, not with {}", now()));
      while (!at_end() && !is_line_end(now()) && now() != '}') ++at_;
      return;
    }
    at_ += key.length;
    skip_blanks();
    if (at_end() || now() != '=') {
      syntax(key, fmt::format("in a block {} is followed by =", key.text()));
      while (!at_end() && !is_line_end(now()) && now() != '}') ++at_;
      return;
    }
    ++at_;
    const Span written = value([&] { return now() == '}' || (after_blank() && is_assignment(at_)); });
    if (!item.block) return;
    const auto fields = item.block->fields;
    const auto known = std::ranges::find_if(fields, [&](const Field& f) { return names(f, {key, {}}); });
    if (known == fields.end()) {
      std::vector<std::string_view> list;
      for (const Field& f : fields) list.push_back(f.name);
      const std::string_view near = nearest_word(key.text(), list);
      diagnostics_.error("unknown-directive", key, fmt::format("{} has no field {}", item.block->name, key.text()),
                         near.empty() ? "" : fmt::format("{} exists", near));
      return;
    }
    if (written.length == 0) {
      diagnostics_.error("directive-value", key, fmt::format("{} has no value", key.text()));
      return;
    }
    std::erase_if(item.fields, [&](const WrittenValue& w) { return names(*known, w); });
    item.fields.push_back({key, written});
  }

  // Its lines as they are, comments included.
  void verbatim(const Span& key) {
    const std::size_t end = text_.find('}', at_);
    if (end == std::string_view::npos) {
      syntax(key, "verbatim has no } at its end");
      at_ = text_.size();
      return;
    }
    WrittenItem item;
    item.written = {key, key};
    while (at_ < end) {
      std::size_t stop = at_;
      while (stop < end && !is_line_end(text_[stop])) ++stop;
      std::string line(text_.substr(at_, stop - at_));
      while (!line.empty() && is_blank(line.back())) line.pop_back();
      item.lines.push_back(std::move(line));
      at_ = stop;
      if (at_ < end) at_ += text_[at_] == '\r' && text_[at_ + 1] == '\n' ? 2 : 1;
    }
    // What stands beside the brackets is a line only if something is there.
    for (std::string* edge :
         {item.lines.empty() ? nullptr : &item.lines.front(), item.lines.empty() ? nullptr : &item.lines.back()}) {
      if (edge) edge->erase(0, std::min(edge->find_first_not_of(" \t"), edge->size()));
    }
    if (!item.lines.empty() && item.lines.back().empty()) item.lines.pop_back();
    if (!item.lines.empty() && item.lines.front().empty()) item.lines.erase(item.lines.begin());
    at_ = end + 1;
    items_.push_back(std::move(item));
  }

  const SourceText& source_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  std::vector<WrittenItem> items_;
};

}  // namespace

std::vector<WrittenItem> parse_configuration(const SourceText& source, Diagnostics& diagnostics) {
  return Parser(source, diagnostics).parse();
}

}  // namespace dynalin::nastran
