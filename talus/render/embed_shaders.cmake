# Writes the text of each file in SHADERS into the C++ file OUTPUT as a constant of
# "talus/render/shaders.h", named after the file with its dot turned into an underscore.
set(text "#include \"talus/render/shaders.h\"\n\nnamespace talus::shaders {\n")
foreach(path IN LISTS SHADERS)
  get_filename_component(name ${path} NAME)
  string(REPLACE "." "_" name ${name})
  file(READ ${path} source)
  string(APPEND text "\nconst std::string_view ${name} = R\"glsl(${source})glsl\";\n")
endforeach()
file(WRITE ${OUTPUT} "${text}\n}  // namespace talus::shaders\n")
