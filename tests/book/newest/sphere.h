#error "the header beside main.cc was found"
