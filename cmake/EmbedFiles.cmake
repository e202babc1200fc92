# Writes a C++ source with the contents of files as string constants. Called as a script:
#   cmake -D OUTPUT=page_assets.cc -D "FILES=report_html=PATH;chart_js=PATH" -P EmbedFiles.cmake
set(source "#include \"wheelwright/page/assets.h\"\n\nnamespace wheelwright::assets {\n\n")
foreach(entry IN LISTS FILES)
  string(REGEX MATCH "^([a-z_]+)=(.*)$" entry "${entry}")
  file(READ "${CMAKE_MATCH_2}" content)
  string(APPEND source "const std::string_view ${CMAKE_MATCH_1} = R\"embedded(${content})embedded\";\n")
endforeach()
string(APPEND source "\n}  // namespace wheelwright::assets\n")
file(WRITE "${OUTPUT}" "${source}")
