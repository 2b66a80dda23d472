incognita_module(messages FOLDERS messages USES incognita::vision incognita::models)
