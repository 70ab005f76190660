// JSON text with an index: eight bytes for each value and name, in the order of the text, which says where
// it stands. Values are read from the text when they are asked for, so that a document costs at most four
// times its text, whatever its shape. It knows nothing of what the members mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace xr3 {

/// JSON that is made, not read: its members keep their order.
using Json = nlohmann::ordered_json;

class JsonValue;

class JsonDocument {
 public:
  /// Lists and objects inside one another, in a file as in a message.
  static constexpr std::size_t kMaxDepth = 32;
  static constexpr std::size_t kMaxLength = std::size_t{1} << 28U;

  enum class Fault : std::uint8_t { kNone, kSyntax, kTooDeep, kTooLong };

  /// Reads a text, which must outlive the document. After a fault the root is nothing.
  explicit JsonDocument(std::string_view text);
  JsonDocument(const JsonDocument&) = delete;
  JsonDocument& operator=(const JsonDocument&) = delete;
  ~JsonDocument() = default;

  Fault fault() const { return fault_; }
  /// Of a fault in the text: where and what.
  struct Complaint {
    std::size_t position = 0;    ///< characters read, the offending one included
    std::size_t token_size = 0;  ///< of the token read last, possibly with what came before it
    std::string message;         ///< the parser's own, cut in its midst where it is long
    std::string pointer;         ///< of what is too deep: what it is in
  };
  const Complaint& complaint() const { return complaint_; }

  JsonValue root() const;
  std::string_view text() const { return text_; }

  /// The names that their object has already, in the order of the text.
  template <class Tell>
  void for_each_duplicate(Tell tell) const;

 private:
  friend class JsonValue;
  friend class JsonIndexer;

  /// A name or a value. `rest` is, of a list or object, the index behind all that is in it; of a text or a
  /// name its length and flags; of a number its length.
  struct Token {
    std::uint32_t begin;
    std::uint32_t rest;
  };
  static constexpr std::uint32_t kLength = (1U << 29U) - 1;
  static constexpr std::uint32_t kIsName = 1U << 29U;
  static constexpr std::uint32_t kIsDuplicate = 1U << 30U;
  static constexpr std::uint32_t kHasEscapes = 1U << 31U;

  void mark_duplicates();
  void mark_duplicates(std::uint32_t object, std::vector<std::uint32_t>& names);

  std::string_view text_;
  std::vector<Token> tokens_;
  Fault fault_ = Fault::kNone;
  Complaint complaint_;
};

/// A value of a document, or nothing: a handle, valid as long as the document.
class JsonValue {
 public:
  JsonValue() = default;

  explicit operator bool() const { return document_ != nullptr; }
  bool operator==(const JsonValue&) const = default;

  // --- What it is. Nothing is of no kind.

  bool is_object() const { return starts_with('{'); }
  bool is_list() const { return starts_with('['); }
  bool is_structured() const { return is_object() || is_list(); }
  bool is_text() const { return starts_with('"'); }
  bool is_null() const { return starts_with('n'); }
  bool is_boolean() const { return starts_with('t') || starts_with('f'); }
  bool is_true() const { return starts_with('t'); }
  bool is_number() const;

  // --- Scalars; the kind must be right.

  double number() const;
  /// The text, or as much of it as makes `most` bytes and a whole letter.
  std::string text(std::size_t most = std::string::npos) const;
  /// Bytes of the text.
  std::size_t text_size() const;

  /// Whether it is this very text, or number; false where it is of another kind.
  bool is(std::string_view text) const;
  bool is(double number) const { return is_number() && this->number() == number; }

  // --- Lists and objects.

  /// Elements or members; it counts them.
  std::size_t size() const;
  /// An element; it walks there. Nothing behind the end.
  JsonValue element(std::size_t index) const;
  /// The member of this name, the last of them, or nothing.
  JsonValue find(std::string_view name) const;
  /// The name of a member: a text. Nothing of an element, or the root.
  JsonValue name() const;
  /// A member whose object has one of its name before it.
  bool is_repeated() const;

  /// Goes through the elements, or the values of the members.
  class Iterator {
   public:
    // NOLINTBEGIN(readability-identifier-naming): std::iterator_traits asks for these
    using iterator_category = std::input_iterator_tag;
    using value_type = JsonValue;
    using difference_type = std::ptrdiff_t;
    using pointer = const JsonValue*;
    using reference = JsonValue;
    // NOLINTEND(readability-identifier-naming)

    JsonValue operator*() const { return {document_, is_object_ ? index_ + 1 : index_}; }
    Iterator& operator++();
    bool operator==(const Iterator& other) const { return index_ == other.index_; }

   private:
    friend class JsonValue;
    const JsonDocument* document_;
    std::uint32_t index_;
    bool is_object_;
  };
  Iterator begin() const;
  Iterator end() const;

  // --- Where it stands.

  /// Its JSON pointer (RFC 6901) from a value around it. A very long one is cut behind kMaxPointerLength.
  std::string pointer_from(JsonValue around) const;
  static constexpr std::size_t kMaxPointerLength = 256;
  /// The value at a pointer from here, or nothing.
  JsonValue at(std::string_view pointer) const;
  /// The same, or the nearest one around it.
  JsonValue nearest(std::string_view pointer) const;
  /// Where it begins in the text, a member with its name.
  std::size_t offset() const;

  // --- As it is written.

  /// Bytes of it as compact JSON; it stops counting above `most`.
  std::size_t json_size(std::size_t most = std::string::npos) const;
  /// A copy: for small ones.
  Json to_json() const;

  /// Characters of the text that it takes, with what stands behind it up to the next value.
  std::size_t extent() const;

 private:
  friend class JsonDocument;
  friend class JsonIndexer;

  using Token = JsonDocument::Token;
  JsonValue(const JsonDocument* document, std::uint32_t index)
      : document_(document), index_(index) {}

  const Token& token() const { return document_->tokens_[index_]; }
  bool starts_with(char c) const {
    return document_ != nullptr && document_->text_[token().begin] == c;
  }
  std::uint32_t next() const;
  std::string_view written() const;
  bool has_escapes() const { return (token().rest & JsonDocument::kHasEscapes) != 0; }
  int compare_text(JsonValue other) const;
  JsonValue child(std::string_view part) const;

  const JsonDocument* document_ = nullptr;
  std::uint32_t index_ = 0;
};

template <class Tell>
void JsonDocument::for_each_duplicate(Tell tell) const {
  for (std::uint32_t i = 1; i < tokens_.size(); ++i)
    if (const JsonValue value(this, i); value.is_repeated()) tell(value);
}

}  // namespace xr3
