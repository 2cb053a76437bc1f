# Writes every template of the atlas as a raw string literal. OUTPUT: the source; TEMPLATES: list of
# JSON files.
set(text "// Made from core/atlas/*.json.\n#include <string>\n#include <vector>\n\nnamespace sporeprint {\n\n")
string(APPEND text "const std::vector<std::string>& built_in_templates() {\n    static const std::vector<std::string> texts = {\n")
foreach(template IN LISTS TEMPLATES)
  file(READ ${template} content)
  # A literal of more than 65535 characters is beyond the standard's minimum: split it.
  string(LENGTH "${content}" length)
  set(at 0)
  string(APPEND text "        std::string()")
  while(at LESS length)
    string(SUBSTRING "${content}" ${at} 12000 piece)
    string(APPEND text " +\n            R\"template(${piece})template\"")
    math(EXPR at "${at} + 12000")
  endwhile()
  string(APPEND text ",\n")
endforeach()
string(APPEND text "    };\n    return texts;\n}\n\n}  // namespace sporeprint\n")
file(WRITE ${OUTPUT} "${text}")
