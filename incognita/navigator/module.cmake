incognita_module(navigator FOLDERS navigator USES incognita::slam incognita::decision)
