// Template definitions for codec.hpp; include codec.hpp instead.
#pragma once

#include <algorithm>

#include "protocol/json/codec.hpp"

namespace xr3::data {
namespace detail {

/// Stores the error for an unknown member, with the most similar allowed name.
void keep_unknown(const Place& member, const std::vector<std::string>& names);

/// `a list of 3`, `a list of 1 to 7`.
std::string list_text(std::size_t min_count, std::size_t max_count);

/// `a whole number from 1 to 255`.
std::string integer_text(std::int64_t min, std::int64_t max);

/// The integer; nullopt if the value is not an integer in the range. Reports nothing.
std::optional<std::int64_t> integer_in(JsonValue value, std::int64_t min, std::int64_t max);

template <class T>
std::vector<std::string> names_of(const Members<T>& members) {
  std::vector<std::string> names;
  for (const Member<T>& member : members) names.push_back(member.name);
  return names;
}

/// Reports members that are not in the table.
template <class T>
void refuse_unknown(const Place& place, const Members<T>& members) {
  for (const JsonValue value : place.value) {
    const bool is_known = std::any_of(
        members.begin(), members.end(),
        [name = value.name()](const Member<T>& member) { return name.is(member.name); });
    if (!is_known && place.reading.keeps_error())
      keep_unknown({place.reading, value}, names_of(members));
  }
}

}  // namespace detail

template <class V>
Codec<V> parsed(std::string allowed, std::function<std::optional<V>(JsonValue)> parse,
                std::function<Json(const V&)> write) {
  const auto read = [allowed, parse](const Place& place, V& result) {
    std::optional<V> value = parse(place.value);
    if (!value) return place.refuse(allowed);
    return result = *std::move(value), true;
  };
  return {std::move(allowed), read, std::move(write)};
}

template <class V, class W>
Codec<V> converted(Codec<W> codec, std::function<V(const W&)> to, std::function<W(const V&)> from) {
  return {codec.allowed,
          [to, read = codec.read](const Place& place, V& result) {
            W value{};
            if (!read(place, value)) return false;
            return result = to(value), true;
          },
          [from, write = codec.write](const V& value) { return write(from(value)); }};
}

template <class V, class F>
Codec<V> row(std::string allowed, Codec<F> item, std::vector<F V::*> fields) {
  const auto read = [=, read = item.read](const Place& place, V& result) {
    if (!place.value.is_list() || place.value.size() != fields.size()) return place.refuse(allowed);
    bool is_good = true;
    auto field = fields.begin();
    for (const JsonValue element : place.value)
      is_good = read({place.reading, element}, result.*(*field++)) && is_good;
    return is_good;
  };
  const auto write = [fields, write = item.write](const V& value) {
    Json list = Json::array();
    for (const auto field : fields) list.push_back(write(value.*field));
    return list;
  };
  return {std::move(allowed), read, write};
}

template <class I>
Codec<I> integer(std::int64_t min, std::int64_t max) {
  return parsed<I>(detail::integer_text(min, max), [=](JsonValue value) -> std::optional<I> {
    const auto number = detail::integer_in(value, min, max);
    return number ? std::optional(static_cast<I>(*number)) : std::nullopt;
  });
}

template <class E>
Codec<E> choice(std::vector<std::pair<std::string, E>> names) {
  std::vector<std::string> known_names;
  for (const auto& [name, value] : names) known_names.push_back(name);
  const auto parse = [names](JsonValue value) -> std::optional<E> {
    for (const auto& [name, wanted] : names)
      if (value.is(name)) return wanted;
    return std::nullopt;
  };
  return parsed<E>(quoted_names(known_names), parse, [names](const E& wanted) {
    const auto known = std::find_if(names.begin(), names.end(),
                                    [&](const auto& entry) { return entry.second == wanted; });
    return Json(known->first);
  });
}

template <class V>
Codec<std::vector<V>> list(Codec<V> item, std::size_t min_count, std::size_t max_count) {
  Codec<std::vector<V>> codec;
  codec.allowed = detail::list_text(min_count, max_count);
  codec.read = [=, allowed = codec.allowed](const Place& place, std::vector<V>& result) {
    const std::size_t count = place.value.is_list() ? place.value.size() : 0;
    if (!place.value.is_list() || count < min_count || count > max_count)
      return place.refuse(allowed);
    result.clear();
    result.reserve(std::min(count, 2 * place.value.extent() / sizeof(V)));
    bool is_good = true;
    for (const JsonValue element : place.value) {
      V each{};
      is_good = item.read({place.reading, element}, each) && is_good;
      if (!place.reading.is_full()) result.push_back(std::move(each));
    }
    return is_good;
  };
  codec.write = [write = item.write](const std::vector<V>& values) {
    Json::array_t array;
    array.reserve(values.size());
    for (const V& value : values) array.push_back(write(value));
    return array;
  };
  return codec;
}

template <class V>
Codec<SharedVector<V>> shared(Codec<std::vector<V>> values) {
  const auto read = [read = values.read](const Place& place, SharedVector<V>& result) {
    std::vector<V> all;
    const bool is_good = read(place, all);
    result = std::move(all);
    return is_good;
  };
  return {values.allowed, read,
          [write = values.write](const SharedVector<V>& all) { return write(all.all()); }};
}

template <class T, class V>
Member<T> required(std::string name, V T::*field, Codec<V> codec) {
  return {
      std::move(name), true, codec.allowed,
      [=, read = codec.read](const Place& place, T& object) { return read(place, object.*field); },
      [=, write = codec.write](const T& object) -> std::optional<Json> {
        return write(object.*field);
      }};
}

template <class T>
Member<T> required(std::string name, Codec<T> codec) {
  return {std::move(name), true, std::move(codec.allowed), std::move(codec.read),
          std::move(codec.write)};
}

template <class T, class V>
Member<T> defaulted(std::string name, V T::*field, Codec<V> codec) {
  Member<T> member = required(std::move(name), field, std::move(codec));
  member.is_required = false;
  return member;
}

template <class T, class V>
Member<T> optional(std::string name, V T::*field, Codec<V> codec) {
  Member<T> member = defaulted(std::move(name), field, codec);
  member.write = [=, write = codec.write](const T& object) -> std::optional<Json> {
    if (object.*field == T{}.*field) return std::nullopt;
    return write(object.*field);
  };
  return member;
}

template <class T, class V>
Member<T> optional(std::string name, std::optional<V> T::*field, Codec<V> codec) {
  return {std::move(name), false, codec.allowed,
          [=, read = codec.read](const Place& place, T& object) {
            return read(place, (object.*field).emplace());
          },
          [=, write = codec.write](const T& object) -> std::optional<Json> {
            if (!(object.*field)) return std::nullopt;
            return write(*(object.*field));
          }};
}

template <class T, class... More>
Members<T> joined(Members<T> first, const More&... more) {
  (first.insert(first.end(), more.begin(), more.end()), ...);
  return first;
}

template <class T, class V>
Members<T> spread(V T::*part, const Members<V>& members) {
  Members<T> result;
  for (const Member<V>& member : members) {
    result.push_back({member.name, member.is_required, member.allowed,
                      [=, read = member.read](const Place& place, T& object) {
                        return read(place, object.*part);
                      },
                      [=, write = member.write](const T& object) { return write(object.*part); }});
  }
  return result;
}

template <class T>
Member<T> length_unit_member() {
  return {"length_unit", false, "", [](const Place&, T&) { return true; },
          [](const T&) -> std::optional<Json> { return Json("mm"); }};
}

template <class T>
bool read_object(const Place& place, const Members<T>& members, T& object) {
  if (!place.value.is_object()) return place.refuse("an object { ... }");
  detail::refuse_unknown(place, members);
  bool is_good = true;
  for (const Member<T>& member : members) {
    if (const JsonValue value = place.value.find(member.name)) {
      is_good = member.read({place.reading, value}, object) && is_good;
    } else if (member.is_required) {
      if (place.reading.keeps_error())
        place.reading.keep_missing(place.value, member.name, member.allowed);
      is_good = false;
    }
  }
  return is_good;
}

template <class T, class Check>
std::optional<T> read_root(Reading& reading, const Members<T>& members, const Check& check) {
  std::optional<T> value(std::in_place);
  read_object(Place{reading, reading.root()}, members, *value);
  check(*value, reading);
  if (reading.has_errors()) value.reset();
  return value;
}

template <class T>
Json write_object(const T& object, const Members<T>& members) {
  Json::object_t json;
  json.reserve(members.size());  // an object that grows copies its members
  for (const Member<T>& member : members) {
    if (auto value = member.write(object)) json[member.name] = *std::move(value);
  }
  return json;
}

template <class T>
Codec<T> object(Members<T> members) {
  return {"an object { ... }",
          [members](const Place& place, T& result) { return read_object(place, members, result); },
          [members](const T& value) { return write_object(value, members); }};
}

template <class T>
void check_names(const std::vector<T>& elements, const std::string& pointer,
                 const std::string& what, Reading& reading) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::string place = child_pointer(pointer, i) + "/name";
    if (!reading.is_sound(place) || names.insert(elements[i].name).second) continue;
    reading.refuse(place, "\"" + elements[i].name + "\", a duplicate",
                   "a name that no other " + what + " has");
  }
}

}  // namespace xr3::data
