#include "nastran_reader/bulk.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace dynalin::nastran_reader {

namespace {

// One line of a card.
struct CardRow {
  std::string name;  // empty for a continuation
  Span at;
  bool large = false, free = false;
  std::string tag_in, tag_out;  // without + or *
  bool continues = false;
  std::vector<Field> fields;  // eight, or four in large field
  std::optional<std::size_t> next;
};

constexpr std::size_t widest_line = 80, name_width = 8;

// A tab goes on to the next multiple of eight columns. `origin[i]` is the column of the file under column i.
struct Columns {
  std::string text;
  std::vector<std::size_t> origin;
};
Columns expanded(std::string_view line) {
  Columns c;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '\t') {
      c.text += line[i];
      c.origin.push_back(i);
      continue;
    }
    do {
      c.text += ' ';
      c.origin.push_back(i);
    } while (c.text.size() % name_width != 0);
  }
  return c;
}

std::string tag_of(std::string_view field) {
  std::string tag = upper_trimmed(field);
  if (!tag.empty() && (tag[0] == '+' || tag[0] == '*')) tag.erase(0, 1);
  return std::string(trimmed(tag));
}

// The name in field 1, or what makes the row a continuation.
void read_head(CardRow& row, std::string_view head) {
  const std::string text = upper_trimmed(head);
  if (text.empty() || text[0] == '+' || text[0] == '*') {
    row.continues = true;
    row.large = !text.empty() && text[0] == '*';
    row.tag_in = tag_of(text);
    return;
  }
  row.name = text;
  if (row.name.back() == '*') {
    row.large = true;
    row.name.pop_back();
    row.name = std::string(trimmed(row.name));
  }
}

class Rows {
 public:
  Rows(std::span<const Line> lines, Diagnostics& diagnostics) : diagnostics_(diagnostics) {
    for (const Line& line : lines) {
      const bool free = line.text.find(',') != std::string_view::npos;
      if (free) {
        read_free(line);
      } else {
        read_fixed(line);
      }
    }
    connect();
  }

  std::vector<Card> cards() const {
    std::vector<Card> out;
    for (const CardRow& first : rows_) {
      if (first.continues) continue;
      Card card{first.name, first.at, first.at, {}};
      for (const CardRow* row = &first; row; row = row->next ? &rows_[*row->next] : nullptr) {
        // A small row begins a row of eight, whatever a large one left open.
        if (!row->large) pad(card, 8);
        card.fields.insert(card.fields.end(), row->fields.begin(), row->fields.end());
      }
      pad(card, 8);
      for (const Field& f : card.fields) {
        if (!f.blank()) card.end = f.at;
      }
      out.push_back(std::move(card));
    }
    return out;
  }

 private:
  static void pad(Card& card, std::size_t multiple) {
    while (card.fields.size() % multiple != 0) {
      Field f;
      f.at = card.fields.empty() ? card.at : card.fields.back().at;
      card.fields.push_back(std::move(f));
    }
  }

  void read_fixed(const Line& line) {
    const Columns columns = expanded(line.text);
    const std::string_view text = columns.text;
    const auto span_of = [&](std::size_t begin, std::size_t length) {
      // Of what is written in these columns.
      std::size_t end = std::min(begin + length, text.size());
      begin = std::min(begin, end);
      while (begin < end && text[begin] == ' ') ++begin;
      while (end > begin && text[end - 1] == ' ') --end;
      if (begin >= columns.origin.size()) return line.span(line.text.size(), 0);
      const std::size_t from = columns.origin[begin];
      return line.span(from, end > begin ? columns.origin[end - 1] + 1 - from : 0);
    };
    CardRow row;
    read_head(row, text.substr(0, std::min(name_width, text.size())));
    row.at = span_of(0, name_width);
    if (text.size() > widest_line && text.find_first_not_of(' ', widest_line) != std::string_view::npos) {
      diagnostics_.warning("field-overflow", span_of(widest_line, text.size()),
                           fmt::format("columns beyond {} are not read", widest_line));
    }
    const std::size_t width = row.large ? 16 : 8, count = row.large ? 4 : 8;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t begin = name_width + i * width;
      const Span at = span_of(begin, width);
      row.fields.push_back(read_field(begin < text.size() ? text.substr(begin, width) : std::string_view(), at));
    }
    for (std::size_t i = 0; i + 1 < count; ++i) {
      // A number that begins in one field and ends in the next is two others.
      const std::size_t border = name_width + (i + 1) * width;
      if (border >= text.size() || text[border] == ' ' || text[border - 1] == ' ') continue;
      if (text[border - width] != ' ' || (text.size() > border + width - 1 && text[border + width - 1] != ' '))
        continue;
      const std::string joined = row.fields[i].text + row.fields[i + 1].text;
      if (read_field(joined, {}).form == Field::Form::real)
        diagnostics_.warning("field-overflow", join(row.fields[i].at, row.fields[i + 1].at),
                             fmt::format("{} stands on the border of two fields, {} and {}", joined, row.fields[i].text,
                                         row.fields[i + 1].text));
    }
    if (text.size() > 72) row.tag_out = tag_of(text.substr(72, 8));
    rows_.push_back(std::move(row));
  }

  void read_free(const Line& line) {
    std::vector<std::pair<std::size_t, std::size_t>> items;  // begin, length
    for (std::size_t begin = 0;;) {
      const std::size_t comma = line.text.find(',', begin);
      const std::size_t end = std::min(comma, line.text.size());
      items.emplace_back(begin, end - begin);
      if (comma == std::string_view::npos) break;
      begin = comma + 1;
    }
    CardRow row;
    row.free = true;
    const auto text_of = [&](std::size_t i) { return line.text.substr(items[i].first, items[i].second); };
    const auto span_of = [&](std::size_t i) {
      const std::string_view t = trimmed(text_of(i));
      if (t.empty()) return line.span(items[i].first, items[i].second);
      return line.span(static_cast<std::size_t>(t.data() - line.text.data()), t.size());
    };
    read_head(row, text_of(0));
    row.at = span_of(0);
    const std::size_t count = row.large ? 4 : 8, widest = row.large ? 16 : 8;
    for (std::size_t i = 1; i <= count; ++i) {
      if (i >= items.size()) {
        row.fields.push_back(read_field({}, line.span(line.text.size(), 0)));
        continue;
      }
      Field f = read_field(text_of(i), span_of(i));
      if (f.text.size() > widest && row.name != "PARAM") {
        diagnostics_.error("field-overflow", f.at,
                           fmt::format("{} has {} characters, and a field {}", f.text, f.text.size(), widest),
                           row.large ? "" : fmt::format("with {}* fields have 16", row.name.empty() ? "" : row.name));
      }
      row.fields.push_back(std::move(f));
    }
    if (items.size() > count + 1) row.tag_out = tag_of(text_of(count + 1));
    for (std::size_t i = count + 2; i < items.size(); ++i) {
      if (trimmed(text_of(i)).empty()) continue;
      diagnostics_.error("field-overflow", span_of(i),
                         fmt::format("a line has {} fields of data and this is one more", count),
                         "go on in a line that begins with a comma");
      break;
    }
    rows_.push_back(std::move(row));
  }

  // Continuations to what they continue: by tag, or to the row above.
  void connect() {
    std::map<std::string, std::vector<std::size_t>> by_tag;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!rows_[i].tag_out.empty()) by_tag[rows_[i].tag_out].push_back(i);
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      CardRow& row = rows_[i];
      if (!row.continues) continue;
      std::optional<std::size_t> parent;
      const bool above =
          i > 0 && (rows_[i - 1].tag_out == row.tag_in || rows_[i - 1].tag_out.empty() || row.tag_in.empty());
      if (!row.tag_in.empty()) {
        const auto found = by_tag.find(row.tag_in);
        if (found != by_tag.end()) {
          const auto& list = found->second;
          // The row above goes first: tags that repeat are common where rows stand together.
          const bool near = i > 0 && rows_[i - 1].tag_out == row.tag_in;
          parent = near ? i - 1 : list.front();
          if (!near && list.size() > 1) {
            diagnostics_.error("lost-continuation", row.at,
                               fmt::format("{} rows end with the tag {}, so that it is open which one goes on here",
                                           list.size(), row.tag_in));
          }
        }
      }
      if (!parent && above) parent = i - 1;
      if (parent && (rows_[*parent].next || *parent == i)) parent.reset();
      if (!parent) {
        const bool alone = i == 0;
        diagnostics_.error(
            "lost-continuation", row.at,
            alone ? std::string("a continuation stands before the first card")
            : row.tag_in.empty()
                ? std::string("this row continues none: the row above already goes on elsewhere")
                : fmt::format("no row ends with the tag {}, or the one that does goes on elsewhere", row.tag_in));
        continue;
      }
      rows_[*parent].next = i;
    }
    break_cycles();
  }

  // Tags can lead in a circle, which no card begins: nothing hangs, and the rows are told.
  void break_cycles() {
    std::vector<bool> reached(rows_.size(), false);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].continues) continue;
      for (std::size_t k = i;; k = *rows_[k].next) {
        reached[k] = true;
        if (!rows_[k].next) break;
      }
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!rows_[i].continues || reached[i] || !rows_[i].next) continue;
      diagnostics_.error("lost-continuation", rows_[i].at, "this row belongs to no card");
    }
  }

  std::vector<CardRow> rows_;
  Diagnostics& diagnostics_;
};

}  // namespace

const Field& Card::field(std::size_t row, std::size_t number) const {
  static const Field none;
  const std::size_t i = row * 8 + number - 2;
  return i < fields.size() ? fields[i] : none;
}

std::vector<Card> read_bulk(std::span<const Line> lines, Diagnostics& diagnostics) {
  return Rows(lines, diagnostics).cards();
}

}  // namespace dynalin::nastran_reader
