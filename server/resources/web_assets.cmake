# Run by the build (cmake -D DIST=... -D OUTPUT=... -P). Writes a C++ file that embeds every file of
# the viewer's folder DIST with .incbin, and a table of them. The table is empty if DIST is empty or
# missing.
file(GLOB_RECURSE files RELATIVE "${DIST}" "${DIST}/*")
list(SORT files)
set(externs "")
set(rows "")
set(bytes "")
set(count 0)
foreach(file IN LISTS files)
  set(name "xr3_web_asset_${count}")
  string(APPEND externs "extern const char ${name}[];\nextern const char ${name}_end[];\n")
  string(APPEND rows "    {\"/${file}\", ${name}, ${name}_end},\n")
  string(APPEND bytes
    "    \".global ${name}, ${name}_end\\n${name}: .incbin \\\"${DIST}/${file}\\\"\\n"
    "${name}_end: .byte 0\\n\"\n")
  math(EXPR count "${count} + 1")
endforeach()
set(text "// Made by server/resources/web_assets.cmake.\n#include \"server/resources/web_assets_table.hpp\"\n\n")
if(count GREATER 0)
  string(APPEND text
    "asm(\".pushsection .rodata\\n\"\n${bytes}    \".popsection\\n\");\n\n"
    "// NOLINTBEGIN(readability-identifier-naming): assembler symbols\n"
    "extern \"C\" {\n${externs}}\n"
    "// NOLINTEND(readability-identifier-naming)\n\n"
    "static const xr3::EmbeddedFile kFiles[] = {\n${rows}};\n\n"
    "std::span<const xr3::EmbeddedFile> xr3::embedded_files() { return kFiles; }\n")
else()
  string(APPEND text "std::span<const xr3::EmbeddedFile> xr3::embedded_files() { return {}; }\n")
endif()
file(WRITE "${OUTPUT}" "${text}")
