#include "object_reader.h"

#include <algorithm>
#include <utility>

#include "nearest_name.h"

namespace phalanx {

namespace {
std::string listed(const std::vector<std::string> &names, const std::string &quote = "") {
  std::string list;
  for (const std::string &name : names) list += (list.empty() ? "" : ", ") + quote + name + quote;
  return list;
}
}  // namespace

ObjectReader::ObjectReader(Node node, Source &source)
    : node_(std::move(node)), source_(source), errors_before_(source.num_errors()) {
  if (!is_object()) source_.expected(node_, "an object {...}");
}

bool ObjectReader::knows(const std::string &key) const {
  return std::find(known_.begin(), known_.end(), key) != known_.end();
}

std::optional<Node> ObjectReader::find(std::string_view key, Presence presence) {
  if (!is_object()) return std::nullopt;
  if (!knows(std::string(key))) known_.emplace_back(key);
  for (const JsonMember &member : node_.value->members()) {
    if (member.key == key) return Node{&member.value, member_path(node_.path, key)};
  }
  if (presence == kRequired) missing_.emplace_back(key);
  return std::nullopt;
}

bool ObjectReader::number(std::string_view key, const Range &range, double &out,
                          Presence presence) {
  const auto member = find(key, presence);
  return member && check_number(*member, range, source_, out);
}

bool ObjectReader::integer(std::string_view key, int lo, int hi, int &out, Presence presence) {
  const auto member = find(key, presence);
  return member && check_integer(*member, lo, hi, source_, out);
}

bool ObjectReader::boolean(std::string_view key, bool &out, Presence presence) {
  const auto member = find(key, presence);
  return member && check_boolean(*member, source_, out);
}

bool ObjectReader::text(std::string_view key, std::string &out, Presence presence) {
  const auto member = find(key, presence);
  return member && check_text(*member, source_, out);
}

bool ObjectReader::vector(std::string_view key, const Range &range, Double3 &out,
                          Presence presence) {
  const auto member = find(key, presence);
  return member && check_vector(*member, range, source_, out);
}

bool ObjectReader::colour(std::string_view key, const Range &range, Double3 &out,
                          Presence presence) {
  const auto member = find(key, presence);
  return member && check_colour(*member, range, source_, out);
}

bool ObjectReader::choice(std::string_view key, const std::vector<Choice> &choices, int &out,
                          Presence presence) {
  const auto member = find(key, presence);
  return member && check_choice(*member, choices, source_, out);
}

std::vector<Node> ObjectReader::array(std::string_view key, const std::string &of_what,
                                      Presence presence) {
  std::vector<Node> items;
  const auto member = find(key, presence);
  if (!member || !check_array(*member, of_what, source_)) return items;
  for (std::size_t i = 0; i < member->value->items().size(); i++) items.push_back(member->item(i));
  return items;
}

bool ObjectReader::is_unreadable(std::string_view key) {
  if (const auto member = find(key)) return member->value->kind != JsonKind::kArray;
  if (!is_object()) return true;
  const auto &members = node_.value->members();
  return std::any_of(members.begin(), members.end(), [&](const JsonMember &member) {
    return !nearest_name(member.key, {std::string(key)}).empty();
  });
}

std::string ObjectReader::meant(const std::string &key) const {
  std::vector<std::string> absent;  // known keys that are not given: the likeliest to be meant
  for (const std::string &known : known_) {
    const auto &members = node_.value->members();
    const bool given = std::any_of(members.begin(), members.end(),
                                   [&](const JsonMember &member) { return member.key == known; });
    if (!given) absent.push_back(known);
  }
  const std::string nearest = nearest_name(key, absent);
  return nearest.empty() ? nearest_name(key, known_) : nearest;
}

void ObjectReader::report_unknown(const std::string &what, bool only_missing) {
  for (const JsonMember &member : node_.value->members()) {
    if (knows(member.key)) continue;
    const std::string nearest = meant(member.key);
    // A key that is missing because it is misspelt is one mistake, not two.
    const bool explains_missing = std::erase(missing_, nearest) > 0;
    if (only_missing && !explains_missing) continue;
    source_.error(member.line, member.column, member_path(node_.path, member.key),
                  "unknown key '" + printable(member.key) + "' in " + what +
                      (nearest.empty() ? "; known keys: " + listed(known_)
                                       : "; did you mean '" + nearest + "'?"));
  }
}

void ObjectReader::report_missing(const std::string &what) {
  if (missing_.empty()) return;
  error((missing_.size() == 1 ? "missing key " : "missing keys ") + listed(missing_, "'") + " of " +
        what);
}

void ObjectReader::finish(const std::string &what) {
  if (!is_object()) return;
  report_unknown(what, false);
  report_missing(what);
}

void ObjectReader::give_up(const std::string &what) {
  if (!is_object()) return;
  report_unknown(what, true);
  report_missing(what);
}

}  // namespace phalanx
