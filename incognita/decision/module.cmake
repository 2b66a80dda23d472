incognita_module(decision FOLDERS decision USES incognita::slam)
