# cmake -D INPUT=<file> -D NAME=<identifier> -D OUTPUT=<file.cpp> -P EmbedFile.cmake
# Makes a source file of any file: an array of its bytes and their number.
file(READ "${INPUT}" digits HEX)
string(LENGTH "${digits}" length)
math(EXPR size "${length} / 2")
string(REGEX REPLACE "(................................)" "\\1\n" digits "${digits}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," digits "${digits}")
file(WRITE "${OUTPUT}" "#include <cstddef>\n"
     "extern const unsigned char ${NAME}[];\nextern const std::size_t ${NAME}Size;\n"
     "const unsigned char ${NAME}[] = {\n${digits}};\n"
     "const std::size_t ${NAME}Size = ${size};\n")
