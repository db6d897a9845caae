# Comments of c_api.h as Doxygen's: that of the file, those before a declaration, those behind a member.
s@^/\*$@/** \\file@
t
s@^/\* ([^-])@/** \1@
s@([;,{]|[A-Za-z0-9]) +/\* @\1 /**< @
