// JSON text with an index: eight bytes for each value and name, in text order, with its position.
// Values are read from the text on access, so that a document needs at most four times the memory
// of its text for any structure. Independent of the meaning of members.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace xr3 {

/// JSON for output; members keep their order. Include nlohmann/json.hpp to use it.
using Json = nlohmann::ordered_json;

/// Offset of the quote that ends a text whose contents begin at `at`; text.size() if there is none.
std::size_t text_end(std::string_view text, std::size_t at);

/// Line and column, from 1, of an offset in a text.
struct TextPlace {
  int line;
  int column;
};
TextPlace place_of(std::string_view text, std::size_t offset);

/// `parent` followed by a member name, escaped according to RFC 6901, or by an index.
std::string child_pointer(const std::string& parent, std::string_view member);
std::string child_pointer(const std::string& parent, std::size_t element);

class JsonValue;

class JsonDocument {
 public:
  /// Maximum nesting of lists and objects, in files and in messages.
  static constexpr std::size_t kMaxDepth = 32;

  enum class SyntaxFault : std::uint8_t { kNone, kSyntax, kTooDeep };

  /// Indexes a text, which must outlive the document. After a fault, root() is empty.
  /// Precondition: the text is shorter than 512 MiB.
  explicit JsonDocument(std::string_view text);
  JsonDocument(const JsonDocument&) = delete;
  JsonDocument& operator=(const JsonDocument&) = delete;
  ~JsonDocument() = default;

  SyntaxFault fault() const { return fault_; }
  /// Position and description of a fault in the text.
  struct Complaint {
    std::size_t position = 0;    ///< bytes read, including the offending one
    std::size_t token_size = 0;  ///< bytes of the last token, possibly with preceding ones
    std::string message;         ///< message of the parser, without the token that it quotes
    std::string pointer;         ///< kTooDeep: pointer to the enclosing value
  };
  const Complaint& complaint() const { return complaint_; }

  JsonValue root() const;
  std::string_view text() const { return text_; }

  /// Calls `visit` with each member whose name the object already has, in text order.
  template <class Visitor>
  void for_each_duplicate(Visitor visit) const;

 private:
  friend class JsonValue;
  friend class JsonIndexer;

  /// A name or a value. `rest` is: for a list or object, the index after its last content; for a
  /// text or name, its length and flags; for a number, its length.
  struct Token {
    std::uint32_t begin;
    std::uint32_t rest;
  };
  static constexpr std::uint32_t kLength = (1U << 29U) - 1;
  static constexpr std::uint32_t kIsName = 1U << 29U;
  static constexpr std::uint32_t kIsDuplicate = 1U << 30U;
  static constexpr std::uint32_t kHasEscapes = 1U << 31U;

  void build_index();
  void mark_duplicates();
  void mark_duplicates(std::uint32_t object, std::vector<std::uint32_t>& names);

  std::string_view text_;
  std::vector<Token> tokens_;
  SyntaxFault fault_ = SyntaxFault::kNone;
  Complaint complaint_;
};

/// A handle to a value of a document, or empty. Valid as long as the document.
class JsonValue {
 public:
  JsonValue() = default;

  explicit operator bool() const { return document_ != nullptr; }
  bool operator==(const JsonValue&) const = default;

  // --- Kind. All are false for an empty handle.

  bool is_object() const { return starts_with('{'); }
  bool is_list() const { return starts_with('['); }
  bool is_structured() const { return is_object() || is_list(); }
  bool is_text() const { return starts_with('"'); }
  bool is_null() const { return starts_with('n'); }
  bool is_boolean() const { return starts_with('t') || starts_with('f'); }
  bool is_true() const { return starts_with('t'); }
  bool is_number() const;

  // --- Scalars. Except for is(), the value must be of the kind.

  double number() const;
  /// The text. A longer one is cut at the first character boundary at or after `most` bytes.
  std::string text(std::size_t most = std::string::npos) const;
  /// The size of the text in bytes.
  std::size_t text_size() const;

  /// Whether the value equals this text or number; false if it is of another kind.
  bool is(std::string_view text) const;
  template <class Texts>
  bool is_one_of(const Texts& texts) const {
    return std::any_of(texts.begin(), texts.end(),
                       [this](const auto& text) { return this->is(text); });
  }
  bool is(double number) const { return is_number() && this->number() == number; }

  // --- Lists and objects.

  /// The number of elements or members. Takes linear time.
  std::size_t size() const;
  /// An element; empty if out of range. Takes linear time.
  JsonValue element(std::size_t index) const;
  /// The last member with this name, or empty.
  JsonValue find(std::string_view name) const;
  /// The name of a member, as a text value. Empty for an element and for the root.
  JsonValue name() const;
  /// Whether an earlier member of the same object has the same name.
  bool is_repeated() const;

  /// Iterates over the elements, or over the values of the members.
  class Iterator {
   public:
    // NOLINTBEGIN(readability-identifier-naming): required by std::iterator_traits
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

  // --- Position.

  /// The JSON pointer (RFC 6901) relative to an enclosing value. Ends early once it has
  /// kMaxPointerLength bytes.
  std::string pointer_from(JsonValue around) const;
  static constexpr std::size_t kMaxPointerLength = 256;
  /// The value at a pointer relative to this value, or empty.
  JsonValue at(std::string_view pointer) const;
  /// The value at a pointer, or the innermost existing value around it.
  JsonValue nearest(std::string_view pointer) const;
  /// Offset in the text; for a member, that of its name.
  std::size_t offset() const;

  // --- Text form.

  /// Size as compact JSON in bytes. Counting stops above `most`.
  std::size_t json_size(std::size_t most = std::string::npos) const;
  /// A copy. Intended for small values.
  Json to_json() const;

  /// Number of bytes in the text from its beginning to the next value.
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

template <class Visitor>
void JsonDocument::for_each_duplicate(Visitor visit) const {
  for (std::uint32_t i = 1; i < tokens_.size(); ++i)
    if (const JsonValue value(this, i); value.is_repeated()) visit(value);
}

}  // namespace xr3
