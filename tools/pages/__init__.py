"""What tools/make-docs is made of: the list docs/numbers.toml, its runs, and the marked blocks of the pages."""
